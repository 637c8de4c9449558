#include <algorithm>

#include "baselines/pointer_mesh.h"
#include "baselines/src/ring_algorithms.h"
#include "baselines/struct_mesh.h"
#include "imr/suite.h"

namespace hedgerow::bench {

namespace {

using baselines::PointerHalfedgeMesh;
using baselines::StructHalfedgeMesh;
using baselines::detail::for_each_outgoing;

// The two meshes by the same names.
baselines::HalfedgeWalk walk_of(const PointerHalfedgeMesh& /*mesh*/) { return {}; }
baselines::StructWalk walk_of(const StructHalfedgeMesh& mesh) {
  return baselines::StructWalk(mesh);
}

template <class Mesh>
class BaselineImr final : public ImrMesh {
 public:
  BaselineImr(const FaceList& faces, Positions positions) : mesh_(faces, positions) {}

  [[nodiscard]] RingSums circulate() override {
    const auto walk = walk_of(mesh_);
    RingSums sums;
    for (Index v = 0; v < mesh_.vertex_count(); ++v) {
      for_each_outgoing(walk, mesh_.vertex(v).halfedge, [&](auto h) {
        ++sums.faces;
        sums.face_ids += static_cast<std::uint64_t>(walk.face_id(h));
      });
    }
    for (Index f = 0; f < mesh_.face_count(); ++f) {
      const auto start = mesh_.face(f).halfedge;
      typename decltype(walk)::Handle h = start;
      do {
        ++sums.vertices;
        sums.vertex_ids += static_cast<std::uint64_t>(walk.origin(h));
        h = walk.next(h);
      } while (h != start);
    }
    return sums;
  }

  void subtract_barycenter() override {
    std::array<double, 3> mean{};
    for (Index v = 0; v < mesh_.vertex_count(); ++v) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        mean[axis] += double{mesh_.vertex(v).position[axis]};
      }
    }
    for (double& x : mean) x /= static_cast<double>(mesh_.vertex_count());
    for (Index v = 0; v < mesh_.vertex_count(); ++v) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        mesh_.vertex(v).position[axis] -= static_cast<float>(mean[axis]);
      }
    }
  }

  void compute_normals() override {
    mesh_.compute_face_normals();
    mesh_.compute_vertex_normals(NormalWeight::uniform);
  }

  void smooth() override {
    for (Index v = 0; v < mesh_.vertex_count(); ++v) {
      if (const Ring ring = ring_of(v); ring.is_inner) {
        const baselines::detail::Vector mean = (1 / ring.valence) * ring.sum;
        baselines::detail::store(mean, mesh_.vertex(v).position);
      }
    }
  }

  void subdivide() override {
    const Index vertex_count = mesh_.vertex_count();
    const Index face_count = mesh_.face_count();
    const Index halfedge_count = mesh_.halfedge_count();
    std::vector<baselines::detail::Vector> points;
    points.reserve(static_cast<std::size_t>(vertex_count));
    for (Index v = 0; v < vertex_count; ++v) points.push_back(subdivided(v));
    for (Index f = 0; f < face_count; ++f) mesh_.split_face(f);
    for (Index v = 0; v < vertex_count; ++v) {
      baselines::detail::store(points[static_cast<std::size_t>(v)], mesh_.vertex(v).position);
    }
    // Of each old edge once: old half-edges are opposite to old ones.
    const auto walk = walk_of(mesh_);
    for (Index h = 0; h < halfedge_count; ++h) {
      if (walk.is_valid(opposite(h)) && is_first(h)) mesh_.flip(h);
    }
  }

  void split_and_collapse() override {
    const Index vertex_count = mesh_.vertex_count();
    const Index face_count = mesh_.face_count();
    for (Index f = 0; f < face_count; ++f) mesh_.split_face(f);
    for (Index v = vertex_count; v < vertex_count + face_count; ++v) mesh_.collapse(v);
    mesh_.compact();
  }

  void move_to(Positions positions) override {
    for (Index v = 0; v < mesh_.vertex_count(); ++v) {
      std::copy_n(positions[v], 3, mesh_.vertex(v).position);
    }
  }
  [[nodiscard]] std::vector<float> vertex_normals() const override {
    return mesh_.vertex_normals();
  }
  [[nodiscard]] ImrSurface surface() const override {
    const auto walk = walk_of(mesh_);
    ImrSurface surface;
    for (Index v = 0; v < mesh_.vertex_count(); ++v) {
      surface.xyz.insert(surface.xyz.end(), mesh_.vertex(v).position, mesh_.vertex(v).position + 3);
    }
    for (Index f = 0; f < mesh_.face_count(); ++f) {
      const auto start = mesh_.face(f).halfedge;
      typename decltype(walk)::Handle h = start;
      do {
        surface.corners.push_back(walk.origin(h));
        h = walk.next(h);
      } while (h != start);
    }
    return surface;
  }

  static std::unique_ptr<ImrMesh> make(const FaceList& faces, Positions positions,
                                       const Execution& /*execution*/) {
    return std::make_unique<BaselineImr>(faces, positions);
  }

 private:
  struct Ring {
    baselines::detail::Vector sum;
    float valence = 0;
    bool is_inner = false;
  };
  Ring ring_of(Index v) const {
    const auto walk = walk_of(mesh_);
    const auto start = mesh_.vertex(v).halfedge;
    Ring ring;
    if (!walk.is_valid(start) || !walk.is_valid(walk.opposite(walk.prev(start)))) return ring;
    ring.is_inner = true;
    for_each_outgoing(walk, start, [&](auto h) {
      ring.sum = ring.sum + baselines::detail::load(walk.position(walk.next(h)));
      ring.valence += 1;
    });
    return ring;
  }
  baselines::detail::Vector subdivided(Index v) const {
    const auto before = baselines::detail::load(mesh_.vertex(v).position);
    const Ring ring = ring_of(v);
    if (!ring.is_inner) return before;
    const auto share = static_cast<float>(sqrt3_share(static_cast<int>(ring.valence)));
    return (1 - share) * before + (share / ring.valence) * ring.sum;
  }

  auto opposite(Index h) const {
    if constexpr (std::is_same_v<Mesh, StructHalfedgeMesh>) {
      return mesh_.halfedge(h).opposite;
    } else {
      return static_cast<const PointerHalfedgeMesh::Halfedge*>(mesh_.halfedge(h).opposite);
    }
  }
  /// Whether h is the smaller of its edge, by number or by address.
  bool is_first(Index h) const {
    if constexpr (std::is_same_v<Mesh, StructHalfedgeMesh>) {
      return h < opposite(h);
    } else {
      return &mesh_.halfedge(h) < opposite(h);
    }
  }

  Mesh mesh_;
};

}  // namespace

std::vector<ImrKind> imr_baselines() {
  const std::vector<ImrRow> all(kImrRows.begin(), kImrRows.end());
  return {{"pointer", all, BaselineImr<PointerHalfedgeMesh>::make},
          {"struct", all, BaselineImr<StructHalfedgeMesh>::make}};
}

}  // namespace hedgerow::bench
