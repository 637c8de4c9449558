#pragma once

#include "hedgerow/buffer.h"
#include "hedgerow/ray/scene.h"
#include "render/camera.h"
#include "render/image.h"
#include "render/palette.h"
#include "run.h"

namespace hedgerow::tool {

struct RenderOptions {
  int width = 1280;
  int height = 960;
  bool wireframe = false;
  int ao_rays = 0;  ///< ambient occlusion: rays a pixel, rounded up to a multiple of 8; 0: none
};

/// What is drawn. `normals` has three floats a vertex.
struct RenderSubject {
  const Connectivity& mesh;
  const Buffer<float>& xyz;
  const Buffer<float>& normals;
  const ray::Scene& scene;  ///< of `mesh` and `xyz`
  const Palette& palette;
};

/// Draws the mesh: eight rays a pixel, each pixel a function of its place alone, so the same
/// picture for every thread count. Reports its progress.
[[nodiscard]] Image render(Run& run, const RenderSubject& subject, const Camera& camera,
                           const RenderOptions& options);

/// Draws the marks of the palette over the picture: solid where the eye sees them, faint where the
/// mesh hides them.
void draw_marks(const RenderSubject& subject, const Camera& camera, Image& image);

}  // namespace hedgerow::tool
