#include "hedgerow/boundary.h"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "at.h"
#include "closed_columns.h"
#include "kernels/boundary_columns.h"
#include "kernels/materialise.h"
#include "parallel/parallel.h"

namespace hedgerow {

namespace {

constexpr Index kBoundaryGrain = 1 << 14;  // vertices or half-edges a task

// The boundary half-edges to be, each named by the half-edge that it will be opposite to.
struct Holes {
  std::vector<Index> sides;  ///< loop by loop
  std::vector<Index> first;  ///< first[i] is where loop i begins; one behind the last
};

// The side after that of h: the hole passes from the half-edge that leaves a vertex at one end of a
// fan to the one that enters it at the other end. Each fan is crossed once, so all loops together
// take O(H).
template <Topology Mesh>
HalfedgeId next_side(const Mesh& mesh, HalfedgeId h) noexcept {
  HalfedgeId side = mesh.prev(h);
  while (mesh.opposite[side].valid()) side = mesh.prev(mesh.opposite[side]);
  return side;
}

template <Topology Mesh>
Holes find_holes(const Mesh& mesh) {
  Holes holes;
  std::vector<bool> seen(at(mesh.halfedge_count()), false);
  for (Index i = 0; i < mesh.halfedge_count(); ++i) {
    if (mesh.opposite[HalfedgeId(i)].valid() || seen[at(i)]) continue;
    holes.first.push_back(static_cast<Index>(holes.sides.size()));
    for (HalfedgeId h(i); !seen[at(h.value)]; h = next_side(mesh, h)) {
      seen[at(h.value)] = true;
      holes.sides.push_back(h.value);
    }
  }
  holes.first.push_back(static_cast<Index>(holes.sides.size()));
  return holes;
}

struct FaceBuffers {
  Buffer<Index> next;
  Buffer<Index> face;
  Buffer<Index> first;
};

// `next`, `face` and `first` of the faces, with room for `size` half-edges.
FaceBuffers face_buffers(const Connectivity& mesh, std::size_t size, const Execution& execution) {
  FaceBuffers columns{Buffer<Index>(size), Buffer<Index>(size),
                      Buffer<Index>(at(mesh.face_count()) + 1)};
  Index* next = columns.next.data();
  Index* face = columns.face.data();
  Index* first = columns.first.data();
  if (mesh.is_explicit()) {
    const PolygonView view = mesh.polygons();
    std::copy_n(view.first_of.data(), view.first_of.size(), first);
  }
  par::for_each_range(execution, mesh.face_count(), kBoundaryGrain, [&](IndexRange range) {
    if (mesh.is_explicit()) {
      kernels::fill_polygon_columns(range, first, next, face);
    } else {
      kernels::fill_triangle_columns(range, next, face, first);
    }
  });
  first[mesh.face_count()] = mesh.halfedge_count();
  return columns;
}

struct BoundaryRun {
  Index* origin;
  Index* opposite;
  Index* next;
  Index* face;
};

// Loops write their own half-edges, and `opposite` of the sides of their own holes.
template <Topology Mesh>
void fill_loop(const Mesh& mesh, const Holes& holes, Index loop, const BoundaryRun& out) noexcept {
  const Index side_count = mesh.halfedge_count();
  const Index begin = holes.first[at(loop)];
  const Index end = holes.first[at(loop + 1)];
  for (Index i = begin; i < end; ++i) {
    const Index side = holes.sides[at(i)];
    const Index b = side_count + i;
    out.origin[b] = mesh.target(HalfedgeId(side)).value;
    out.opposite[b] = side;
    out.opposite[side] = b;
    out.next[b] = side_count + (i + 1 < end ? i + 1 : begin);
    out.face[b] = kInvalidIndex;
  }
}

template <Topology Mesh>
detail::ClosedColumns close(const Connectivity& owner, const Mesh& mesh, const Holes& holes,
                            const Execution& execution) {
  const std::size_t size = at(mesh.halfedge_count()) + holes.sides.size();
  FaceBuffers faces = face_buffers(owner, size, execution);
  Buffer<Index> origin = detail::extended(owner.origin(), size);
  Buffer<Index> opposite = detail::extended(owner.opposite(), size);
  const BoundaryRun out{origin.data(), opposite.data(), faces.next.data(), faces.face.data()};
  par::for_each_range(execution, static_cast<Index>(holes.first.size()) - 1, kBoundaryGrain,
                      [&](IndexRange loops) {
                        for (Index i = loops.begin; i < loops.end; ++i) {
                          fill_loop(mesh, holes, i, out);
                        }
                      });
  Buffer<Index> outgoing(at(mesh.vertex_count()));
  par::for_each_range(execution, mesh.vertex_count(), kBoundaryGrain, [&](IndexRange range) {
    kernels::gather_closed_outgoing(range, mesh, opposite.data(), outgoing.data());
  });
  auto fans = Buffer<FanStart>::copy_of(owner.fans());
  for (FanStart& fan : fans) fan.start = kernels::closed_start(mesh, fan.start, opposite.data());
  return {std::move(origin),     std::move(opposite),    std::move(outgoing), std::move(faces.next),
          std::move(faces.face), std::move(faces.first), std::move(fans)};
}

detail::ClosedColumns copy_of_closed(const Connectivity& mesh) {
  const PolygonView view = mesh.polygons();
  const auto copy = [](const auto& column) {
    return Buffer<Index>::copy_of({column.data(), at(column.size())});
  };
  return {copy(view.origin),
          copy(view.opposite),
          copy(view.outgoing),
          copy(view.next_of),
          copy(view.face_of),
          copy(view.first_of),
          Buffer<FanStart>::copy_of(mesh.fans())};
}

// One fan of a vertex in the default form, by its smallest half-edge.
struct OpenFan {
  Index smallest;
  Index start;
};

// The fans into which the boundary half-edges on the rotation from `start` cut it.
void cut_rotation(const PolygonView& mesh, HalfedgeId start, std::vector<OpenFan>& fans) {
  OpenFan current{start.value, start.value};
  OpenFan leading = current;  // what precedes the first boundary half-edge closes the ring
  bool is_cut = false;
  HalfedgeId h = start;
  do {
    if (mesh.face(h).valid()) {
      current.smallest = std::min(current.smallest, h.value);
    } else {
      if (is_cut) fans.push_back(current);
      if (!is_cut) leading = current;
      is_cut = true;
      const HalfedgeId first = mesh.next(mesh.opposite[h]);
      current = {first.value, first.value};
    }
    h = mesh.next(mesh.opposite[h]);
  } while (h != start);
  if (is_cut && mesh.face(start).valid()) {
    current.smallest = std::min(current.smallest, leading.smallest);
  }
  fans.push_back(current);
}

void open_vertex(const PolygonView& mesh, VertexId v, Index& outgoing,
                 std::vector<OpenFan>& scratch, std::vector<FanStart>& extra) {
  const HalfedgeId start = mesh.outgoing[v];
  const FanTable others = extra_fans(mesh.fans, v);
  outgoing = start.value;
  if (!start.valid() || (others.empty() && mesh.face(start).valid())) return;
  scratch.clear();
  cut_rotation(mesh, start, scratch);
  for (const FanStart& fan : others) cut_rotation(mesh, fan.start, scratch);
  std::sort(scratch.begin(), scratch.end(),
            [](const OpenFan& a, const OpenFan& b) { return a.smallest < b.smallest; });
  outgoing = scratch[0].start;
  for (std::size_t i = 1; i < scratch.size(); ++i) {
    extra.push_back({v, HalfedgeId(scratch[i].start)});
  }
}

void open_vertices(const PolygonView& mesh, const Execution& execution,
                   ConnectivityColumns& columns) {
  Buffer<Index> outgoing(at(mesh.vertex_count()));
  const Index chunk_count = (mesh.vertex_count() + kBoundaryGrain - 1) / kBoundaryGrain;
  std::vector<std::vector<FanStart>> found(at(chunk_count));
  par::for_each_task(execution, chunk_count, [&](Index chunk, Index) {
    std::vector<OpenFan> scratch;
    const Index end = std::min(mesh.vertex_count(), (chunk + 1) * kBoundaryGrain);
    for (Index v = chunk * kBoundaryGrain; v < end; ++v) {
      open_vertex(mesh, VertexId(v), outgoing[at(v)], scratch, found[at(chunk)]);
    }
  });
  std::vector<FanStart> fans;
  for (const auto& part : found) fans.insert(fans.end(), part.begin(), part.end());
  columns.outgoing = std::move(outgoing);
  columns.fans = Buffer<FanStart>::copy_of(fans);
}

struct Smallest {
  Index element = kInvalidIndex;  // none yet
};

Index find_not_openable(const PolygonView& mesh, const Execution& execution) {
  const Smallest found = par::reduce<Smallest>(
      execution, mesh.halfedge_count(), kBoundaryGrain,
      [&](IndexRange range) { return Smallest{kernels::find_not_openable(range, mesh)}; },
      [](Smallest a, Smallest b) {
        if (a.element == kInvalidIndex) return b;
        if (b.element == kInvalidIndex) return a;
        return Smallest{std::min(a.element, b.element)};
      });
  return found.element;
}

}  // namespace

Buffer<Index> detail::extended(std::span<const Index> column, std::size_t size) {
  Buffer<Index> copy(size);
  std::copy(column.begin(), column.end(), copy.begin());
  return copy;
}

Result<detail::ClosedColumns> detail::closed_columns(const Connectivity& mesh,
                                                     const Execution& execution) {
  if (mesh.form() == Form::closed) return copy_of_closed(mesh);
  return mesh.visit([&](const auto& view) -> Result<ClosedColumns> {
    const Holes holes = find_holes(view);
    const std::int64_t count =
        mesh.halfedge_count() + static_cast<std::int64_t>(holes.sides.size());
    if (count > kMaxCount) {
      return fail({ErrorCode::too_many_elements, kInvalidIndex, count, kMaxCount});
    }
    return close(mesh, view, holes, execution);
  });
}

Result<Connectivity> close_boundary(const Connectivity& mesh, const Execution& execution) {
  if (mesh.form() == Form::closed) return fail({ErrorCode::already_closed});
  auto closed = detail::closed_columns(mesh, execution);
  if (!closed) return fail(closed.error());
  ConnectivityColumns columns;
  columns.form = Form::closed;
  columns.all_triangles = mesh.is_triangle_mesh();
  columns.fans = std::move(closed->fans);
  columns.origin = std::move(closed->origin);
  columns.opposite = std::move(closed->opposite);
  columns.outgoing = std::move(closed->outgoing);
  columns.next = std::move(closed->next);
  columns.face = std::move(closed->face);
  columns.first = std::move(closed->first);
  return Connectivity(std::move(columns));
}

Result<Connectivity> open_boundary(const Connectivity& mesh, const Execution& execution) {
  if (mesh.form() == Form::open) return fail({ErrorCode::already_open});
  const PolygonView view = mesh.polygons();
  if (const Index h = find_not_openable(view, execution); h != kInvalidIndex) {
    return fail({ErrorCode::not_canonical, h});
  }
  const Index side_count = view.first_of[FaceId(view.face_count())].value;
  const auto size = at(side_count);
  ConnectivityColumns columns;
  columns.all_triangles = mesh.is_triangle_mesh();
  columns.origin = Buffer<Index>::copy_of(mesh.origin().first(size));
  Buffer<Index> opposite(size);
  par::for_each_range(execution, side_count, kBoundaryGrain, [&](IndexRange range) {
    kernels::gather_open_opposites(range, view, side_count, opposite.data());
  });
  columns.opposite = std::move(opposite);
  open_vertices(view, execution, columns);
  if (!columns.all_triangles) {
    columns.next = Buffer<Index>::copy_of({view.next_of.data(), size});
    columns.face = Buffer<Index>::copy_of({view.face_of.data(), size});
    columns.first = Buffer<Index>::copy_of({view.first_of.data(), at(view.first_of.size())});
  }
  return Connectivity(std::move(columns));
}

}  // namespace hedgerow
