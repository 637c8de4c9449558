#include "hedgerow/dirty_normals.h"

#include <algorithm>
#include <bit>

#include "at.h"
#include "gather_plan.h"
#include "kernels/face_normals.h"
#include "kernels/gather_normals.h"
#include "kernels/index_set.h"
#include "normals_check.h"
#include "parallel/parallel.h"

namespace hedgerow {

namespace {

constexpr Index kDirtyFaceGrain = 1 << 12;
constexpr Index kAllFrom = 8;  // everything is dirty once one vertex in so many has moved

Buffer<std::byte> zero_bits(Index size) {
  return Buffer<std::byte>(size > 0 ? kernels::IndexSet::bytes(size) : 0, std::byte{0});
}

// Calls visit(position, vertex) for all that are named.
template <class Visit>
void for_each_moved(const MovedVertices& moved, const Visit& visit) {
  for (std::size_t i = 0; i < moved.ids().size(); ++i) {
    visit(static_cast<Index>(i), moved.ids()[i]);
  }
  for (Index v = moved.range().begin; v < moved.range().end; ++v) visit(v, v);
  for (std::size_t w = 0; w < moved.words().size(); ++w) {
    for (std::uint64_t word = moved.words()[w]; word != 0; word &= word - 1) {
      const auto v = static_cast<Index>(64 * w + at(static_cast<Index>(std::countr_zero(word))));
      visit(v, v);
    }
  }
}

// Inserts the faces round each vertex. Several rings are walked at once, as each step waits for
// memory: the rest of a frame has thrown the columns out of the caches.
void insert_rings(const TriangleView& mesh, std::span<const Index> ids,
                  kernels::IndexSet& faces) noexcept {
  struct Walk {
    Index start;
    Index halfedge;
  };
  constexpr std::size_t kWalks = 8;
  constexpr std::size_t kAhead = 32;
  Walk walks[kWalks];
  std::size_t count = 0;
  const Index* outgoing = mesh.outgoing.data();
  for (std::size_t next = 0; count > 0 || next < ids.size();) {
    for (; count < kWalks && next < ids.size(); ++next) {
      __builtin_prefetch(outgoing + ids[std::min(next + kAhead, ids.size() - 1)]);
      const Index start = outgoing[ids[next]];
      if (start >= 0) walks[count++] = {start, start};
    }
    for (std::size_t i = 0; i < count;) {
      Walk& walk = walks[i];
      faces.insert(mesh.face(HalfedgeId(walk.halfedge)).value);
      const HalfedgeId opposite = mesh.opposite[HalfedgeId(walk.halfedge)];
      walk.halfedge = opposite.valid() ? mesh.next(opposite).value : walk.start;
      if (walk.halfedge == walk.start) {
        walk = walks[--count];
      } else {
        ++i;
      }
    }
  }
  if (mesh.fans.empty()) return;
  for (const Index v : ids) {
    kernels::for_each_face(mesh, VertexId(v), [&](Index f) { faces.insert(f); });
  }
}

template <class Mesh>
void insert_rings(const Mesh& mesh, std::span<const Index> ids, kernels::IndexSet& faces) noexcept {
  for (const Index v : ids) {
    kernels::for_each_face(mesh, VertexId(v), [&](Index f) { faces.insert(f); });
  }
}

// The vertices of all those faces.
template <class Mesh>
void insert_corners(const Mesh& mesh, std::span<const Index> faces,
                    kernels::IndexSet& vertices) noexcept {
  constexpr std::size_t kAhead = 16;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const Index far = faces[std::min(i + kAhead, faces.size() - 1)];
    __builtin_prefetch(mesh.origin.data() + mesh.first(FaceId(far)).value);
    const FaceId f(faces[i]);
    const Index begin = mesh.first(f).value;
    const auto insert = [&](Index corner) {
      vertices.insert(mesh.origin[HalfedgeId(begin + corner)].value);
    };
    if constexpr (std::is_same_v<Mesh, TriangleView>) {
      for (const Index corner : {0, 1, 2}) insert(corner);
    } else {
      for (Index corner = 0; corner < mesh.degree(f); ++corner) insert(corner);
    }
  }
}

struct Named {
  std::int64_t count = 0;
  Error error{ErrorCode::index_out_of_range, kInvalidIndex, 0, 0, 0};
};

Named count_moved(const MovedVertices& moved, Index vertex_count) {
  Named named;
  named.error.limit = vertex_count;
  const auto note = [&](Index position, Index v) {
    if (named.error.count++ > 0) return;
    named.error.element = position;
    named.error.value = v;
  };
  const IndexRange range = moved.range();
  if (range.begin < range.end) {
    named.count += range.size();
    if (range.begin < 0) note(range.begin, range.begin);
    if (range.end > vertex_count) note(std::max(range.begin, vertex_count), range.end - 1);
  }
  const auto look = [&](Index position, Index v) {
    ++named.count;
    if (v < 0 || v >= vertex_count) note(position, v);
  };
  for_each_moved(MovedVertices::list(moved.ids()), look);
  for_each_moved(MovedVertices::bitmap(moved.words()), look);
  return named;
}

}  // namespace

DirtySet::DirtySet(const Connectivity& mesh)
    : vertex_bits_(zero_bits(mesh.vertex_count())),
      face_bits_(zero_bits(mesh.face_count())),
      faces_(at(mesh.face_count())),
      vertices_(at(mesh.vertex_count())),
      ring_faces_(mesh.is_triangle_mesh() ? 0 : at(mesh.face_count())) {}

template <class Mesh>
void DirtySet::collect(const Mesh& mesh, const MovedVertices& moved) {
  kernels::IndexSet face_set(face_bits_.data(), mesh.face_count());
  kernels::IndexSet vertex_set(vertex_bits_.data(), mesh.vertex_count());
  insert_rings(mesh, moved.ids(), face_set);
  const auto insert_ring = [&](Index, Index v) {
    kernels::for_each_face(mesh, VertexId(v), [&](Index f) { face_set.insert(f); });
  };
  for_each_moved(MovedVertices::range(moved.range()), insert_ring);
  for_each_moved(MovedVertices::bitmap(moved.words()), insert_ring);
  face_count_ = face_set.drain_into(faces_.data());
  insert_corners(mesh, faces(), vertex_set);
  vertex_count_ = vertex_set.drain_into(vertices_.data());
  if (ring_faces_.empty()) return;
  insert_rings(mesh, vertices(), face_set);
  ring_face_count_ = face_set.drain_into(ring_faces_.data());
}

Result<void> DirtySet::find(const Connectivity& mesh, const MovedVertices& moved) {
  HEDGEROW_ASSERT(vertices_.size() == at(mesh.vertex_count()));
  const Named named = count_moved(moved, mesh.vertex_count());
  if (named.error.count > 0) return fail(named.error);
  face_count_ = vertex_count_ = ring_face_count_ = 0;
  is_all_ = named.count > 0 && named.count >= mesh.vertex_count() / kAllFrom;
  if (is_all_ || named.count == 0 || mesh.face_count() == 0) return {};
  mesh.visit([&](const auto& view) { collect(view, moved); });
  return {};
}

Result<NormalStats> update_face_normals(const Connectivity& mesh, Positions positions,
                                        NormalsOut out, const NormalOptions& options,
                                        const DirtySet& dirty, const Execution& execution) {
  if (dirty.is_all()) return face_normals(mesh, positions, out, options, execution);
  if (auto ok = detail::check_arrays(positions, mesh.vertex_count(), out, mesh.face_count()); !ok) {
    return fail(ok.error());
  }
  const kernels::FaceSource source(face_list(mesh));
  const kernels::Points points{positions};
  const kernels::NormalWriter writer{out, options.degenerate};
  const std::span<const Index> faces = dirty.faces();
  // A few hundred bytes of each frame's positions are far apart; asked for together, they come
  // together.
  for (const Index v : dirty.vertices()) __builtin_prefetch(positions[v]);
  return par::reduce<NormalStats>(
      execution, static_cast<Index>(faces.size()), kDirtyFaceGrain,
      [&](IndexRange range) {
        NormalStats stats;
        // Faces that follow each other are one range, several of which lanes take at a time.
        for (Index i = range.begin; i < range.end;) {
          const Index begin = faces[at(i)];
          Index end = begin;
          for (; i < range.end && faces[at(i)] == end; ++i) ++end;
          stats = kernels::merge(
              stats, kernels::face_normals({begin, end}, source, points, options.polygon, writer));
        }
        return stats;
      },
      kernels::merge);
}

Result<NormalStats> update_vertex_normals(const Connectivity& mesh, Positions positions,
                                          NormalsOut out, const NormalOptions& options,
                                          const DirtySet& dirty, const Execution& execution,
                                          Workspace& workspace) {
  if (dirty.is_all()) {
    return gather_vertex_normals(mesh, positions, out, options, execution, workspace);
  }
  const std::int64_t vertex_count = mesh.vertex_count();
  if (auto ok = detail::check_arrays(positions, vertex_count, out, vertex_count); !ok) {
    return fail(ok.error());
  }
  const std::span<const Index> vertices = dirty.vertices();
  if (vertices.empty()) return NormalStats{};
  const detail::GatherPlan plan = detail::gather_plan(mesh, options, execution);
  if (!workspace.reserve(plan.scratch_bytes())) {
    return fail({ErrorCode::scratch_too_small, kInvalidIndex,
                 static_cast<std::int64_t>(workspace.size_bytes()),
                 static_cast<std::int64_t>(plan.scratch_bytes())});
  }
  detail::GatherScratch scratch(plan, workspace);
  const kernels::FaceSource source(face_list(mesh));
  kernels::GatherInput input{{positions},
                             options.weight,
                             mesh.origin().data(),
                             mesh.opposite().data(),
                             mesh.halfedge_count(),
                             mesh.is_triangle_mesh(),
                             nullptr};
  if (kernels::Wide* vectors = scratch.face_vectors(); vectors != nullptr) {
    const std::span<const Index> faces = dirty.ring_faces();
    par::for_each_range(execution.with_grain(0), static_cast<Index>(faces.size()), kDirtyFaceGrain,
                        [&](IndexRange range) {
                          for (Index i = range.begin; i < range.end; ++i) {
                            const Index f = faces[at(i)];
                            kernels::fill_face_vectors({f, f + 1}, source, input.points,
                                                       options.weight, options.polygon, vectors);
                          }
                        });
    input.faces = vectors;
  }
  const kernels::NormalWriter writer{out, options.degenerate};
  const auto count = static_cast<Index>(vertices.size());
  // Rounded up, so that there are no more tasks than of all vertices, of which there are at least
  // kAllFrom times as many: the scratch memory is for those.
  const Index grain = (plan.grain - 1) / kAllFrom + 1;
  const Index task_count = (count - 1) / grain + 1;
  return mesh.visit([&](const auto& view) {
    return par::reduce_tasks<NormalStats>(
        execution, task_count,
        [&](Index task, Index slot) {
          bool is_zero = false;
          kernels::IndexSet spill = scratch.spill(slot, view.halfedge_count(), is_zero);
          const Index begin = task * grain;
          const Index size = count - begin < grain ? count - begin : grain;
          return kernels::gather_normals(vertices.data() + begin, size, view, input, spill, writer);
        },
        kernels::merge);
  });
}

}  // namespace hedgerow
