#pragma once

#include <algorithm>
#include <utility>

#include "hedgerow/circulate.h"
#include "hedgerow/index.h"
#include "hedgerow/topology.h"
#include "kernels/radix.h"

/// The columns of a mesh under new numbers. Each kernel reads anywhere and writes only the elements
/// of its own range (for faces: of their half-edges), so ranges that partition them are disjoint;
/// `scatter_inverse` writes elsewhere, but a permutation sends no two elements to one place.
namespace hedgerow::kernels {

/// items[f] = the smallest new number among the vertices of old face f.
template <Topology Mesh>
void gather_smallest_vertex(IndexRange faces, const Mesh& mesh, const Index* vertices_old_to_new,
                            IndexedItem* items) noexcept {
  for (Index f = faces.begin; f < faces.end; ++f) {
    const Index first = mesh.first(FaceId(f)).value;
    const Index degree = mesh.degree(FaceId(f));
    Index smallest = vertices_old_to_new[mesh.origin[HalfedgeId(first)].value];
    for (Index k = 1; k < degree; ++k) {
      const Index v = vertices_old_to_new[mesh.origin[HalfedgeId(first + k)].value];
      smallest = v < smallest ? v : smallest;
    }
    items[f] = {static_cast<decltype(IndexedItem::key)>(smallest), f};
  }
}

/// Puts faces that are sorted by their smallest vertex in order of their second one, too, and of
/// old number where both are the same.
///
/// \pre `order` is sorted by smallest new vertex.
template <Topology Mesh>
class FaceRuns {
 public:
  FaceRuns(const Mesh& mesh, const Index* vertices_old_to_new, Index* order) noexcept
      : mesh_(mesh), vertices_old_to_new_(vertices_old_to_new), order_(order) {}

  /// The first place from i > 0 on whose face has another smallest vertex than the one before.
  [[nodiscard]] Index end_of_run(Index i, Index n) const noexcept {
    if (i >= n) return n;
    const Index smallest = two_smallest(order_[i - 1]).first;
    while (i < n && two_smallest(order_[i]).first == smallest) ++i;
    return i;
  }

  /// Sorts the runs of `range`, none of which may reach beyond it.
  void sort(IndexRange range) noexcept {
    Index run = range.begin;
    Index smallest = kInvalidIndex;
    for (Index i = range.begin; i < range.end; ++i) {
      const Index own = two_smallest(order_[i]).first;
      if (own == smallest) continue;
      sort_run(run, i);
      run = i;
      smallest = own;
    }
    sort_run(run, range.end);
  }

 private:
  using Pair = std::pair<Index, Index>;

  // Of a face all of whose corners are at one vertex, the second is the number of vertices.
  [[nodiscard]] Pair two_smallest(Index f) const noexcept {
    const Index first = mesh_.first(FaceId(f)).value;
    const Index degree = mesh_.degree(FaceId(f));
    Pair found{vertices_old_to_new_[mesh_.origin[HalfedgeId(first)].value], mesh_.vertex_count()};
    for (Index k = 1; k < degree; ++k) {
      const Index v = vertices_old_to_new_[mesh_.origin[HalfedgeId(first + k)].value];
      found.second = std::min(found.second, std::max(found.first, v));
      found.first = std::min(found.first, v);
    }
    return found;
  }

  void sort_run(Index begin, Index end) noexcept {
    const auto key = [&](Index f) { return std::pair(two_smallest(f).second, f); };
    std::sort(order_ + begin, order_ + end, [&](Index f, Index g) { return key(f) < key(g); });
  }

  const Mesh& mesh_;
  const Index* vertices_old_to_new_;
  Index* order_;
};

/// inverse[permutation[i]] = i
inline void scatter_inverse(IndexRange range, const Index* permutation, Index* inverse) noexcept {
  for (Index i = range.begin; i < range.end; ++i) inverse[permutation[i]] = i;
}

/// outer[i] = inner[outer[i]]
inline void gather_composed(IndexRange range, const Index* inner, Index* outer) noexcept {
  for (Index i = range.begin; i < range.end; ++i) outer[i] = inner[outer[i]];
}

/// The new numbers of half-edges: those of a face stay together and in order, so the faces tell.
///
/// \pre `first` holds the first half-edge of each new face (null: 3 f).
template <Topology Mesh>
class HalfedgeMap {
 public:
  HalfedgeMap(const Mesh& mesh, const Index* faces_old_to_new, const Index* first) noexcept
      : mesh_(mesh), faces_old_to_new_(faces_old_to_new), first_(first) {}

  [[nodiscard]] Index first_of(Index f_new) const noexcept {
    return first_ != nullptr ? first_[f_new] : 3 * f_new;
  }
  /// Asks for what operator() will read.
  void ask(HalfedgeId h_old) const noexcept {
    __builtin_prefetch(faces_old_to_new_ + mesh_.face(h_old).value);
  }
  [[nodiscard]] Index operator()(HalfedgeId h_old) const noexcept {
    const FaceId f = mesh_.face(h_old);
    return first_of(faces_old_to_new_[f.value]) + (h_old.value - mesh_.first(f).value);
  }

 private:
  const Mesh& mesh_;
  const Index* faces_old_to_new_;
  const Index* first_;
};

/// What the half-edges of the new faces were.
///
/// \pre `first` holds the first half-edge of each new face (null: 3 f).
template <Topology Mesh>
void gather_halfedges(IndexRange faces, const Mesh& mesh, const Index* faces_new_to_old,
                      const Index* first, Index* halfedges_new_to_old) noexcept {
  for (Index f = faces.begin; f < faces.end; ++f) {
    const FaceId f_old(faces_new_to_old[f]);
    const Index begin = first != nullptr ? first[f] : 3 * f;
    const Index begin_old = mesh.first(f_old).value;
    const Index degree = mesh.degree(f_old);
    for (Index k = 0; k < degree; ++k) halfedges_new_to_old[begin + k] = begin_old + k;
  }
}

/// How many faces ahead a gather asks for what it will read: two loads that depend on each other,
/// one at this distance and one at twice it.
inline constexpr Index kFacesAhead = 16;

/// Calls `visit(h, h_old)` for the half-edges of the new faces, and some faces before that `ask(g)`
/// for what belongs to the old half-edge g. Both read `values`, a column of old half-edges.
template <Topology Mesh, class Value, class Ask, class Visit>
void for_each_moved_halfedge(IndexRange faces, const Mesh& mesh, const Index* faces_new_to_old,
                             const HalfedgeMap<Mesh>& map, const Column<HalfedgeId, Value>& values,
                             const Ask& ask, const Visit& visit) noexcept {
  for (Index f = faces.begin; f < faces.end; ++f) {
    if (faces.end - f > 2 * kFacesAhead) {
      const FaceId far(faces_new_to_old[f + 2 * kFacesAhead]);
      __builtin_prefetch(values.data() + mesh.first(far).value);
      const FaceId near(faces_new_to_old[f + kFacesAhead]);
      const Index begin = mesh.first(near).value;
      for (Index k = 0; k < 3; ++k) ask(HalfedgeId(begin + k));
    }
    const FaceId f_old(faces_new_to_old[f]);
    const Index begin = map.first_of(f);
    const Index begin_old = mesh.first(f_old).value;
    const Index degree = mesh.degree(f_old);
    for (Index k = 0; k < degree; ++k) visit(begin + k, HalfedgeId(begin_old + k));
  }
}

template <Topology Mesh>
void gather_origins(IndexRange faces, const Mesh& mesh, const Index* faces_new_to_old,
                    const HalfedgeMap<Mesh>& map, const Index* vertices_old_to_new,
                    Index* origin) noexcept {
  const auto ask = [&](HalfedgeId h) {
    __builtin_prefetch(vertices_old_to_new + mesh.origin[h].value);
  };
  const auto visit = [&](Index h, HalfedgeId h_old) {
    origin[h] = vertices_old_to_new[mesh.origin[h_old].value];
  };
  for_each_moved_halfedge(faces, mesh, faces_new_to_old, map, mesh.origin, ask, visit);
}

template <Topology Mesh>
void gather_opposites(IndexRange faces, const Mesh& mesh, const Index* faces_new_to_old,
                      const HalfedgeMap<Mesh>& map, Index* opposite) noexcept {
  const auto ask = [&](HalfedgeId h) {
    const HalfedgeId other = mesh.opposite[h];
    if (other.valid()) map.ask(other);
  };
  const auto visit = [&](Index h, HalfedgeId h_old) {
    const HalfedgeId other = mesh.opposite[h_old];
    opposite[h] = other.valid() ? map(other) : kInvalidIndex;
  };
  for_each_moved_halfedge(faces, mesh, faces_new_to_old, map, mesh.opposite, ask, visit);
}

/// One fan as the builder would start it: at its end if it is open, else at its smallest half-edge.
struct Fan {
  HalfedgeId start;
  HalfedgeId smallest;
};

/// \pre `start` is a half-edge that starts a fan; any of them if the fan is closed.
template <Topology Mesh>
[[nodiscard]] Fan find_fan(const Mesh& mesh, HalfedgeId start) noexcept {
  Fan fan{start, start};
  HalfedgeId h = start;
  do {
    if (h < fan.smallest) fan.smallest = h;
    const HalfedgeId opposite = mesh.opposite[h];
    h = opposite.valid() ? mesh.next(opposite) : HalfedgeId();
  } while (h.valid() && h != start);
  if (h.valid()) fan.start = fan.smallest;
  return fan;
}

/// outgoing[v] = the smallest half-edge of `halfedges` that leaves v; other vertices are left as
/// they are. Two calls may run side by side if they write to arrays of their own.
inline void scatter_smallest_outgoing(IndexRange halfedges, const Index* origin,
                                      Index* outgoing) noexcept {
  // From the last to the first, so that the smallest is what remains.
  for (Index h = halfedges.end; h-- > halfedges.begin;) outgoing[origin[h]] = h;
}

/// Takes over what another array has for the vertices in `range` that have none.
inline void gather_missing_outgoing(IndexRange range, const Index* other,
                                    Index* outgoing) noexcept {
  for (Index v = range.begin; v < range.end; ++v) {
    if (outgoing[v] == kInvalidIndex) outgoing[v] = other[v];
  }
}

/// outgoing[v] = where the open fan of v starts, for each half-edge of `range` that such a fan ends
/// with; vertices with several fans are left as they are. A single fan has one end, so no two
/// ranges write the same.
///
/// \pre `old_fans` are the extra fans under old numbers.
template <Topology Mesh>
void scatter_open_starts(IndexRange range, const Mesh& mesh, FanTable old_fans,
                         const Index* vertices_new_to_old, Index* outgoing) noexcept {
  for (Index h = range.begin; h < range.end; ++h) {
    if (mesh.opposite[HalfedgeId(h)].valid()) continue;
    const HalfedgeId start = mesh.next(HalfedgeId(h));
    const VertexId v = mesh.origin[start];
    if (extra_fans(old_fans, VertexId(vertices_new_to_old[v.value])).empty()) {
      outgoing[v.value] = start.value;
    }
  }
}

}  // namespace hedgerow::kernels
