#include <atomic>
#include <optional>
#include <utility>

#include "hedgerow/build.h"
#include "hedgerow/circulate.h"
#include "hedgerow/normals.h"
#include "hedgerow/smooth.h"
#include "hedgerow/subdivide.h"
#include "imr/center.h"
#include "imr/suite.h"
#include "parallel_ranges.h"

namespace hedgerow::bench {

namespace {

/// How to get at vertex normals, and at smoothed positions.
enum class Way : std::uint8_t { usual, walk, buffered };

template <Topology Mesh>
RingSums sums_of_faces(const Mesh& mesh, Index begin, Index end) {
  RingSums sums;
  for (Index v = begin; v < end; ++v) {
    for (const FaceId f : incident_faces(mesh, VertexId(v))) {
      ++sums.faces;
      sums.face_ids += static_cast<std::uint64_t>(f.value);
    }
  }
  return sums;
}
template <Topology Mesh>
RingSums sums_of_vertices(const Mesh& mesh, Index begin, Index end) {
  RingSums sums;
  for (Index f = begin; f < end; ++f) {
    for (const VertexId v : vertices(mesh, FaceId(f))) {
      ++sums.vertices;
      sums.vertex_ids += static_cast<std::uint64_t>(v.value);
    }
  }
  return sums;
}

/// Sums of many ranges, in whatever order: whole numbers.
class SharedSums {
 public:
  void add(const RingSums& sums) noexcept {
    faces_ += sums.faces;
    face_ids_ += sums.face_ids;
    vertices_ += sums.vertices;
    vertex_ids_ += sums.vertex_ids;
  }
  [[nodiscard]] RingSums total() const noexcept {
    return {faces_, face_ids_, vertices_, vertex_ids_};
  }

 private:
  std::atomic<std::int64_t> faces_ = 0;
  std::atomic<std::uint64_t> face_ids_ = 0;
  std::atomic<std::int64_t> vertices_ = 0;
  std::atomic<std::uint64_t> vertex_ids_ = 0;
};

class HedgerowImr final : public ImrMesh {
 public:
  HedgerowImr(Connectivity mesh, Positions positions, const Execution& execution, Way way)
      : mesh_(std::move(mesh)),
        execution_(execution),
        way_(way),
        xyz_(packed(positions)),
        face_normals_(3 * static_cast<std::size_t>(mesh_.face_count())),
        vertex_normals_(xyz_.size()) {}

  [[nodiscard]] RingSums circulate() override {
    SharedSums sums;
    mesh_.visit([&](const auto& view) {
      for_ranges(execution_, view.vertex_count(), kGrain,
                 [&](Index begin, Index end) { sums.add(sums_of_faces(view, begin, end)); });
      for_ranges(execution_, view.face_count(), kGrain,
                 [&](Index begin, Index end) { sums.add(sums_of_vertices(view, begin, end)); });
    });
    return sums.total();
  }

  void subtract_barycenter() override { center(xyz_, execution_); }

  void compute_normals() override {
    NormalOptions options;
    options.weight = NormalWeight::uniform;
    const NormalsOut faces{face_normals_.data(), mesh_.face_count()};
    const NormalsOut vertices{vertex_normals_.data(), mesh_.vertex_count()};
    (void)hedgerow::face_normals(mesh_, positions(), faces, options, execution_);
    if (way_ == Way::walk) {
      (void)gather_vertex_normals(mesh_, positions(), vertices, options, execution_, workspace_);
    } else {
      (void)scatter_vertex_normals(face_list(mesh_), positions(), vertices, options, execution_,
                                   workspace_);
    }
  }

  void smooth() override {
    SmoothOptions options;
    options.update = way_ == Way::buffered ? SmoothUpdate::double_buffered : SmoothUpdate::in_place;
    (void)hedgerow::smooth(mesh_, {xyz_.data(), mesh_.vertex_count()}, options, execution_,
                           workspace_);
  }

  void subdivide() override {
    SubdivisionOptions options;
    options.scheme = SubdivisionScheme::sqrt3;
    auto result = hedgerow::subdivide(mesh_, positions(), options, execution_);
    if (result) subdivided_.emplace(std::move(*result));
  }

  void move_to(Positions positions) override {
    xyz_ = packed(positions);
    subdivided_.reset();
  }
  [[nodiscard]] std::vector<float> vertex_normals() const override {
    return {vertex_normals_.begin(), vertex_normals_.end()};
  }
  [[nodiscard]] ImrSurface surface() const override {
    const auto copy = [](const Buffer<float>& xyz, const Connectivity& mesh) -> ImrSurface {
      const auto corners = mesh.origin();
      return {{xyz.begin(), xyz.end()}, {corners.begin(), corners.end()}};
    };
    return subdivided_ ? copy(subdivided_->positions, subdivided_->mesh) : copy(xyz_, mesh_);
  }

  template <Way way>
  static std::unique_ptr<ImrMesh> make(const FaceList& faces, Positions positions,
                                       const Execution& execution) {
    Result<BuildOutput> built = build(faces, BuildOptions(), execution);
    if (!built) return nullptr;
    return std::make_unique<HedgerowImr>(std::move(built->mesh), positions, execution, way);
  }

 private:
  static constexpr std::size_t kGrain = 4096;

  static Buffer<float> packed(Positions positions) {
    return Buffer<float>::copy_of({positions.data, static_cast<std::size_t>(3 * positions.count)});
  }
  [[nodiscard]] Positions positions() const { return {xyz_.data(), mesh_.vertex_count()}; }

  Connectivity mesh_;
  Execution execution_;
  Way way_;
  Buffer<float> xyz_;
  Buffer<float> face_normals_;
  Buffer<float> vertex_normals_;
  Workspace workspace_;
  std::optional<SubdivisionOutput> subdivided_;
};

}  // namespace

std::vector<ImrKind> imr_hedgerow() {
  std::vector<ImrKind> kinds;
  kinds.push_back({"",
                   {ImrRow::circulator, ImrRow::barycenter, ImrRow::normals, ImrRow::smoothing,
                    ImrRow::subdivision},
                   HedgerowImr::make<Way::usual>,
                   true});
  kinds.push_back({"walk", {ImrRow::normals}, HedgerowImr::make<Way::walk>, true});
  kinds.push_back({"buffered", {ImrRow::smoothing}, HedgerowImr::make<Way::buffered>, true, false});
  return kinds;
}

}  // namespace hedgerow::bench
