#include "dataset.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <stdexcept>
#include <utility>

#include "baselines/struct_mesh.h"
#include "hedgerow/build.h"
#include "mesh_source.h"

namespace hedgerow::bench {

namespace {

Soup make_soup(const DatasetKey& key) {
  if (!key.path.empty()) return read_soup(key.path);
  return generate_soup(key.shape, key.triangle_count);
}

/// Builds, and leaves in the soup only the faces that the engine keeps.
Connectivity build_kept(Soup& soup) {
  BuildOptions options;
  options.borrow_corners = true;
  Result<BuildOutput> built = build(soup.face_list(), options, Execution::serial());
  if (!built) throw std::runtime_error(std::string("not buildable: ") + name(built.error().code));
  if (built->faces_new_to_old.empty()) return std::move(built->mesh);
  const Connectivity& kept = built->mesh;
  Buffer<Index> offsets;
  if (!kept.is_triangle_mesh()) {
    const auto& first = kept.polygons().first_of;
    offsets = Buffer<Index>::copy_of({first.data(), static_cast<std::size_t>(first.size())});
  }
  soup.corners = Buffer<Index>::copy_of(built->mesh.origin());
  soup.offsets = std::move(offsets);
  return build_kept(soup);
}

Reference make_reference(const Dataset& data) {
  baselines::StructHalfedgeMesh mesh(data.faces(), data.positions());
  Reference reference;
  reference.opposite = mesh.opposite();
  mesh.compute_face_normals();
  reference.face_normals = mesh.face_normals();
  mesh.compute_vertex_normals(NormalWeight::area);
  reference.area_normals = mesh.vertex_normals();
  mesh.compute_vertex_normals(NormalWeight::uniform);
  reference.uniform_normals = mesh.vertex_normals();
  reference.one_ring_sums.resize(static_cast<std::size_t>(data.mesh.vertex_count()));
  mesh.fill_one_ring_sums(reference.one_ring_sums);
  reference.boundary_loops = mesh.boundary_loop_count();
  reference.components = mesh.component_count();
  return reference;
}

std::vector<std::unique_ptr<Dataset>>& made_datasets() {
  static std::vector<std::unique_ptr<Dataset>> made;
  return made;
}

}  // namespace

std::string DatasetKey::family() const { return shape == "reordered" ? "grid" : shape; }

std::string DatasetKey::size() const {
  const auto rounded = [](std::int64_t count, std::int64_t unit) {
    return std::to_string((count + unit / 2) / unit);
  };
  const std::int64_t count = triangle_count;
  if (count >= 1'000'000) return rounded(count, 1'000'000) + "M";
  if (count >= 1'000) return rounded(count, 1'000) + "k";
  return std::to_string(count);
}

std::string DatasetKey::working_set() const {
  // Connectivity, positions and one normal a vertex; half as many vertices as triangles.
  constexpr std::int64_t kTriangleBytes = 26 + 6 + 6;
  const std::int64_t bytes = triangle_count * kTriangleBytes;
  if (bytes <= std::int64_t{32} << 10U) return "L1";
  if (bytes <= std::int64_t{1} << 20U) return "L2";
  if (bytes <= std::int64_t{64} << 20U) return "LLC";
  return "DRAM";
}

const Reference& Dataset::reference() const {
  if (!reference_) reference_ = make_reference(*this);
  return *reference_;
}

Counts counts_of(const Dataset& data) noexcept {
  return {static_cast<double>(data.mesh.halfedge_count()),
          static_cast<double>(data.mesh.vertex_count()),
          static_cast<double>(data.mesh.face_count())};
}

const Dataset& dataset(const DatasetKey& key) {
  std::vector<std::unique_ptr<Dataset>>& made = made_datasets();
  for (const auto& data : made) {
    if (data->key == key) return *data;
  }
  auto data = std::make_unique<Dataset>();
  data->key = key;
  data->soup = make_soup(key);
  data->mesh = build_kept(data->soup);
  made.push_back(std::move(data));
  return *made.back();
}

void forget_other_datasets(const DatasetKey& key) {
  std::erase_if(made_datasets(), [&](const std::unique_ptr<Dataset>& data) {
    return data->key.family() != key.family() || data->key.size() != key.size();
  });
}

std::string compare_normals(std::span<const float> normals, std::span<const float> expected,
                            float tolerance, std::span<const Index> skipped) {
  if (normals.size() != expected.size()) return "another number of normals; not measured";
  for (std::size_t i = 0; i < normals.size(); ++i) {
    // Written so that a difference that is not a number counts as different.
    const bool is_equal = std::abs(normals[i] - expected[i]) <= tolerance;
    if (is_equal || std::ranges::binary_search(skipped, static_cast<Index>(i / 3))) continue;
    return "normal " + std::to_string(i / 3) + " is " + std::to_string(normals[i]) + " in axis " +
           std::to_string(i % 3) + ", not " + std::to_string(expected[i]) + "; not measured";
  }
  return "";
}

std::vector<Index> vertices_with_several_fans(const Connectivity& mesh) {
  std::vector<Index> vertices;
  for (const FanStart fan : mesh.fans()) vertices.push_back(fan.vertex.value);
  return vertices;
}

}  // namespace hedgerow::bench
