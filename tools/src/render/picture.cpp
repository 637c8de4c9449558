#include "render/picture.h"

#include "clock.h"
#include "failure.h"
#include "hedgerow/normals.h"

namespace hedgerow::tool {
namespace {

Buffer<float> smooth_normals(Run& run, const std::string& name, const Connectivity& mesh,
                             const Soup& soup) {
  Buffer<float> normals(soup.xyz.size());
  Workspace workspace;
  NormalOptions options;
  options.weight = NormalWeight::angle;
  const auto stats =
      gather_vertex_normals(mesh, soup.positions(), {normals.data(), soup.vertex_count()}, options,
                            run.execution(), workspace);
  if (!stats) throw describe(stats.error(), name);
  return normals;
}

/// Vertices on faces: what the camera has to take in.
std::vector<Vec3> visible_points(const Connectivity& mesh, const Soup& soup,
                                 const Palette& palette) {
  std::vector<Vec3> points;
  for (Index v = 0; v < soup.vertex_count(); ++v) {
    if (mesh.outgoing()[static_cast<std::size_t>(v)] == kInvalidIndex) continue;
    points.push_back(to_vector(soup.positions()[v]));
  }
  for (const Mark& mark : palette.marks) points.push_back(mark.from);
  return points;
}

}  // namespace

Picture make_picture(Run& run, const std::string& name, const BuildFacts& facts, const Soup& kept,
                     Shading shading, const RenderOptions& options) {
  const Connectivity& mesh = facts.built.mesh;
  run.progress().step("building the tree");
  Picture picture;
  const Clock tree_clock;
  const Result<ray::Device> device = ray::Device::create();
  if (!device) throw describe(device.error(), name);
  const Result<ray::Scene> scene =
      ray::Scene::build(*device, mesh, ray::PaddedPositions::of(kept.xyz), {.is_watertight = true},
                        Execution::serial());
  if (!scene) throw describe(scene.error(), name);
  picture.tree_ms = tree_clock.ms();

  run.progress().step("drawing");
  const Clock draw_clock;
  const Palette palette = make_palette(shading, facts, kept.positions(), run.execution());
  const Buffer<float> normals = smooth_normals(run, name, mesh, kept);
  const Camera camera(visible_points(mesh, kept, palette), options.width, options.height);
  const RenderSubject subject{mesh, kept.xyz, normals, *scene, palette};
  Image image = render(run, subject, camera, options);
  draw_marks(subject, camera, image);
  picture.draw_ms = draw_clock.ms();
  picture.png = png_bytes(image);
  picture.legend = palette.legend;
  picture.legend_json = legend_json(palette);
  return picture;
}

}  // namespace hedgerow::tool
