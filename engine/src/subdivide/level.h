#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "at.h"
#include "hedgerow/subdivide.h"
#include "kernels/refine.h"
#include "parallel/parallel.h"

/// What the schemes of subdivision have in common: one level, from the default form to itself.
namespace hedgerow::subdivision {

inline constexpr Index kLevelGrain = 1 << 13;  // parent elements a task

// A level of the subdivision, in the default form; what it starts from is the caller's.
struct Level {
  const Connectivity* mesh = nullptr;
  Positions positions;
  const float* sharpness = nullptr;  // null: no creases
};

struct Ranks {
  Buffer<Index> before;  ///< marked elements before each element
  Index count = 0;
};

// Chunks are counted, then numbered from where the ones before them end: the same numbers however
// the chunks are shared out.
template <class IsMarked>
Ranks rank_marked(const Execution& execution, Index count, const IsMarked& is_marked) {
  Ranks ranks{Buffer<Index>(at(count)), 0};
  const Index chunk_count = (count + kLevelGrain - 1) / kLevelGrain;
  std::vector<Index> first(at(chunk_count));
  const auto end_of = [&](Index chunk) {
    return std::min(count - chunk * kLevelGrain, kLevelGrain);
  };
  par::for_each_task(execution, chunk_count, [&](Index chunk, Index) {
    Index marked = 0;
    for (Index i = 0; i < end_of(chunk); ++i) marked += is_marked(chunk * kLevelGrain + i) ? 1 : 0;
    first[at(chunk)] = marked;
  });
  for (Index& begin : first) {
    const Index marked = begin;
    begin = ranks.count;
    ranks.count += marked;
  }
  par::for_each_task(execution, chunk_count, [&](Index chunk, Index) {
    Index rank = first[at(chunk)];
    for (Index i = 0; i < end_of(chunk); ++i) {
      ranks.before[at(chunk * kLevelGrain + i)] = rank;
      rank += is_marked(chunk * kLevelGrain + i) ? 1 : 0;
    }
  });
  return ranks;
}

template <Topology Mesh>
Ranks rank_edges(const Mesh& mesh, const Execution& execution) {
  return rank_marked(execution, mesh.halfedge_count(), [&](Index h) {
    return kernels::smaller_side(mesh, HalfedgeId(h)).value == h;
  });
}

inline Result<Index> checked_count(std::int64_t count) {
  if (count <= kMaxCount) return static_cast<Index>(count);
  return fail({ErrorCode::too_many_elements, kInvalidIndex, count, kMaxCount});
}

// One level while it is made: columns, positions, and the first half-edge found at each vertex.
struct Child {
  Child(Index vertex_count, Index halfedge_count)
      : origin(at(halfedge_count)),
        opposite(at(halfedge_count)),
        outgoing(at(vertex_count)),
        xyz(3 * at(vertex_count)) {}

  [[nodiscard]] kernels::ChildColumns columns() noexcept {
    return {origin.data(), opposite.data()};
  }
  [[nodiscard]] float* point(Index v) noexcept { return xyz.data() + 3 * at(v); }

  Buffer<Index> origin;
  Buffer<Index> opposite;
  Buffer<Index> outgoing;
  Buffer<float> xyz;
  std::vector<FanStart> fans;
};

// Every fan of an old vertex becomes one; they may change places, as they are sorted by their
// smallest half-edge.
template <Topology Mesh, class ChildMesh, class Seed>
void renew_fans(const Mesh& mesh, const ChildMesh& child_mesh, const Seed& seed, Child& child) {
  std::vector<kernels::ChildFan> renewed;
  for (std::size_t i = 0; i < mesh.fans.size();) {
    const VertexId v = mesh.fans[i].vertex;
    renewed.assign(1, kernels::child_fan(child_mesh, seed(mesh.outgoing[v])));
    for (; i < mesh.fans.size() && mesh.fans[i].vertex == v; ++i) {
      renewed.push_back(kernels::child_fan(child_mesh, seed(mesh.fans[i].start)));
    }
    std::sort(renewed.begin(), renewed.end(),
              [](const auto& a, const auto& b) { return a.smallest < b.smallest; });
    child.outgoing[at(v.value)] = renewed[0].start;
    for (std::size_t k = 1; k < renewed.size(); ++k) {
      child.fans.push_back({v, HalfedgeId(renewed[k].start)});
    }
  }
}

// `seed(h)` leaves the origin of h in the child.
template <Topology Mesh, class ChildMesh, class Seed>
void start_old(const Mesh& mesh, const ChildMesh& child_mesh, const Seed& seed,
               const Execution& execution, Child& child) {
  par::for_each_range(execution, mesh.vertex_count(), kLevelGrain, [&](IndexRange range) {
    for (Index v = range.begin; v < range.end; ++v) {
      const HalfedgeId start = mesh.outgoing[VertexId(v)];
      child.outgoing[at(v)] =
          start.valid() ? kernels::child_fan(child_mesh, seed(start)).start : kInvalidIndex;
    }
  });
  renew_fans(mesh, child_mesh, seed, child);
}

// The same where the children of the half-edges round a vertex are those round it in the child, in
// the same order: `child_of(h)` leaves the origin of h, and ascends with it. So the fans of the
// parent, which are a quarter as far apart, tell where those of the child start.
template <Topology Mesh, class ChildMesh, class ChildOf>
void start_old_as_before(const Mesh& mesh, const ChildMesh& child_mesh, const ChildOf& child_of,
                         const Execution& execution, Child& child) {
  par::for_each_range(execution, mesh.vertex_count(), kLevelGrain, [&](IndexRange range) {
    for (Index v = range.begin; v < range.end; ++v) {
      const HalfedgeId start = mesh.outgoing[VertexId(v)];
      child.outgoing[at(v)] =
          start.valid() ? child_of(HalfedgeId(kernels::child_fan(mesh, start).start)).value
                        : kInvalidIndex;
    }
  });
  renew_fans(mesh, child_mesh, child_of, child);
}

inline TriangleView triangle_view(const Child& child) noexcept {
  const auto count = static_cast<Index>(child.origin.size());
  return {{child.origin.data(), count}, {child.opposite.data(), count}, {}, {}};
}

inline Connectivity finish_triangles(Child& child) {
  ConnectivityColumns columns;
  columns.all_triangles = true;
  columns.origin = std::move(child.origin);
  columns.opposite = std::move(child.opposite);
  columns.outgoing = std::move(child.outgoing);
  columns.fans = Buffer<FanStart>::copy_of(child.fans);
  return Connectivity(std::move(columns));
}

// What each half of an edge keeps of its sharpness; the edges inside a parent face are smooth.
template <Topology Mesh, class Halves>
Buffer<float> halve_sharpness(const Mesh& mesh, const float* sharpness, std::size_t size,
                              const Halves& halves, const Execution& execution) {
  if (sharpness == nullptr) return {};
  Buffer<float> child(size, 0.0F);
  par::for_each_range(execution, mesh.halfedge_count(), kLevelGrain, [&](IndexRange range) {
    for (Index i = range.begin; i < range.end; ++i) {
      const HalfedgeId h(i);
      const HalfedgeId across = mesh.opposite[h];
      float s = sharpness[i];
      if (across.valid() && sharpness[across.value] > (s > 0 ? s : 0)) s = sharpness[across.value];
      const float left = s > 1 ? s - 1 : 0.0F;
      const auto [first, second] = halves(h);
      child[at(first)] = left;
      child[at(second)] = left;
    }
  });
  return child;
}

/// \pre the mesh of `level` is in the default form.
[[nodiscard]] Result<SubdivisionOutput> refine_quads(const Level& level,
                                                     const Execution& execution);
/// \pre all faces are triangles, too.
[[nodiscard]] Result<SubdivisionOutput> refine_quarters(const TriangleView& mesh,
                                                        const Level& level,
                                                        const Execution& execution);
/// \pre as above; no face has two boundary edges if they are to be cut.
[[nodiscard]] Result<SubdivisionOutput> refine_thirds(const TriangleView& mesh, const Level& level,
                                                      bool cuts_boundary,
                                                      const Execution& execution);

}  // namespace hedgerow::subdivision
