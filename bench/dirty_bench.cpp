// hedgerow/dirty_normals.h: normals of faces and vertices after some vertices moved, beside those
// of a full pass.
#include <algorithm>
#include <memory>
#include <vector>

#include "hedgerow/circulate.h"
#include "hedgerow/dirty_normals.h"
#include "runner.h"

namespace hedgerow::bench {

namespace {

constexpr Index kPart = 100;  // of the vertices one in so many moves

/// Vertices round the one in the middle of the numbers, ring by ring, in ascending order.
std::vector<Index> blob(const Dataset& data) {
  const Index count = data.mesh.vertex_count();
  const auto wanted = static_cast<std::size_t>(count / kPart + 1);
  std::vector<bool> is_in(static_cast<std::size_t>(count), false);
  std::vector<Index> found = {count / 2};
  is_in[static_cast<std::size_t>(count / 2)] = true;
  data.mesh.visit([&](const auto& view) {
    for (std::size_t i = 0; i < found.size() && found.size() < wanted; ++i) {
      for (const VertexId v : neighbours(view, VertexId(found[i]))) {
        if (is_in[static_cast<std::size_t>(v.value)] || found.size() == wanted) continue;
        is_in[static_cast<std::size_t>(v.value)] = true;
        found.push_back(v.value);
      }
    }
  });
  std::ranges::sort(found);
  return found;
}

std::vector<Index> scattered(const Dataset& data) {
  std::vector<Index> found;
  for (Index v = kPart / 2; v < data.mesh.vertex_count(); v += kPart) found.push_back(v);
  return found;
}

std::vector<Index> all(const Dataset& data) {
  std::vector<Index> found;
  for (Index v = 0; v < data.mesh.vertex_count(); ++v) found.push_back(v);
  return found;
}

/// The normals of a mesh, kept from frame to frame.
struct Frame {
  explicit Frame(const Dataset& data, std::vector<Index>&& moved_vertices)
      : faces(3 * static_cast<std::size_t>(data.mesh.face_count()), 0.0F),
        vertices(3 * static_cast<std::size_t>(data.mesh.vertex_count()), 0.0F),
        dirty(data.mesh),
        moved(std::move(moved_vertices)) {}

  static NormalsOut view(Buffer<float>& xyz) noexcept {
    return {xyz.data(), static_cast<std::int64_t>(xyz.size() / 3)};
  }
  void compute(const Dataset& data, const Execution& execution) {
    is_done = dirty.find(data.mesh, MovedVertices::list(moved)) &&
              update_face_normals(data.mesh, data.positions(), view(faces), {}, dirty, execution) &&
              update_vertex_normals(data.mesh, data.positions(), view(vertices), {}, dirty,
                                    execution, workspace);
  }

  Buffer<float> faces;
  Buffer<float> vertices;
  Workspace workspace;
  DirtySet dirty;
  std::vector<Index> moved;
  bool is_done = false;
};

using Moved = std::vector<Index> (*)(const Dataset&);

Work prepare(const Dataset& data, const Execution& execution, Moved moved) {
  auto frame = std::make_shared<Frame>(data, moved(data));
  // What the last frame left: right everywhere but at what moves now.
  Frame full(data, all(data));
  full.compute(data, execution);
  std::ranges::copy(full.faces, frame->faces.begin());
  std::ranges::copy(full.vertices, frame->vertices.begin());
  for (const Index v : frame->moved) {
    std::fill_n(frame->vertices.data() + 3 * static_cast<std::size_t>(v), 3, 9.0F);
  }
  Work work;
  work.run = [&data, execution, frame] { frame->compute(data, execution); };
  work.check = [&data, frame]() -> std::string {
    if (!frame->is_done) return "the operation failed; not measured";
    const std::string wrong =
        compare_normals(frame->faces.span(), data.reference().face_normals, kNormalTolerance, {});
    if (!wrong.empty()) return wrong;
    return compare_normals(frame->vertices.span(), data.reference().area_normals, kNormalTolerance,
                           vertices_with_several_fans(data.mesh));
  };
  work.digest = [frame] { return digest_of(frame->vertices); };
  work.notes = [frame] {
    return Notes{{"moved", static_cast<double>(frame->moved.size())},
                 {"dirty_vertices", static_cast<double>(frame->dirty.vertices().size())},
                 {"dirty_faces", static_cast<double>(frame->dirty.faces().size())}};
  };
  return work;
}

/// Of a full pass: positions and corners are read for faces and for vertices, and the columns of
/// the walk; the share that is dirty is not the same for every mesh.
Traffic no_traffic(const Dataset&) { return {}; }

}  // namespace

void add_dirty(const Plan& plan) {
  constexpr std::pair<const char*, Moved> kVariants[] = {
      {"full", all}, {"blob1", blob}, {"scatter1", scattered}};
  for (const DatasetKey& key : plan.large) {
    for (const int threads : plan.threads) {
      for (const auto& variant : kVariants) {
        add({"dirty_normals", key, threads, variant.first,
             [moved = variant.second](const Dataset& data, const Execution& execution) {
               return prepare(data, execution, moved);
             },
             no_traffic, Mix::triad});
      }
    }
  }
}

}  // namespace hedgerow::bench
