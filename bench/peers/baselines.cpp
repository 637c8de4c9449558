#include <utility>

#include "baselines/pointer_mesh.h"
#include "baselines/struct_mesh.h"
#include "peers/peers.h"

namespace hedgerow::bench {

namespace {

template <class Mesh>
class BaselineMesh final : public MeasuredMesh {
 public:
  BaselineMesh(const FaceList& faces, Positions positions) : mesh_(faces, positions) {}

  [[nodiscard]] std::vector<Index> opposite() const override { return mesh_.opposite(); }
  void compute_face_normals() override { mesh_.compute_face_normals(); }
  void compute_vertex_normals() override {
    mesh_.compute_face_normals();
    mesh_.compute_vertex_normals(NormalWeight::area);
  }
  [[nodiscard]] std::vector<float> face_normals() const override { return mesh_.face_normals(); }
  [[nodiscard]] std::vector<float> vertex_normals() const override {
    return mesh_.vertex_normals();
  }
  void fill_one_ring_sums(std::span<std::uint32_t> sums) const override {
    mesh_.fill_one_ring_sums(sums);
  }
  [[nodiscard]] Index component_count() const override { return mesh_.component_count(); }

  static std::unique_ptr<MeasuredMesh> build(const FaceList& faces, Positions positions) {
    return std::make_unique<BaselineMesh>(faces, positions);
  }

 private:
  Mesh mesh_;
};

}  // namespace

extern const Peer kPointerPeer = {"pointer", BaselineMesh<baselines::PointerHalfedgeMesh>::build,
                                  true,      NormalWeight::area,
                                  false,     true};
extern const Peer kStructPeer = {"struct", BaselineMesh<baselines::StructHalfedgeMesh>::build,
                                 true,     NormalWeight::area,
                                 false,    true};

}  // namespace hedgerow::bench
