#include <algorithm>
#include <cmath>
#include <vector>

#include "render/renderer.h"

namespace hedgerow::tool {
namespace {

constexpr float kStep = 0.5F;     // pixels between the dots that a line is drawn as
constexpr float kHidden = 0.18F;  // how solid a mark is behind the mesh
constexpr float kNear = 4e-4F;    // of the distance: nearer to a mark than this hides nothing
constexpr int kMaxDots = 4000;    // of one line; more than any picture is wide

/// How much of each pixel marks cover, and in which colour: the strongest dot wins, of equally
/// strong ones the last.
struct Layer {
  std::vector<float> strength;
  std::vector<std::uint32_t> rrggbb;
};

void draw_dot(const Image& image, Layer& layer, const Projected& at, float radius, float solid,
              std::uint32_t rrggbb) {
  const int left = std::max(0, static_cast<int>(at.x - radius - 1));
  const int right = std::min(image.width() - 1, static_cast<int>(at.x + radius + 1));
  const int top = std::max(0, static_cast<int>(at.y - radius - 1));
  const int bottom = std::min(image.height() - 1, static_cast<int>(at.y + radius + 1));
  for (int y = top; y <= bottom; ++y) {
    for (int x = left; x <= right; ++x) {
      const float off =
          std::hypot(static_cast<float>(x) + 0.5F - at.x, static_cast<float>(y) + 0.5F - at.y);
      const float strength = std::clamp(radius + 0.5F - off, 0.0F, 1.0F) * solid;
      const auto i = static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width()) +
                     static_cast<std::size_t>(x);
      if (strength > 0 && strength >= layer.strength[i]) {
        layer.strength[i] = strength;
        layer.rrggbb[i] = rrggbb;
      }
    }
  }
}

void draw_mark(const RenderSubject& subject, const Camera& camera, const Image& image,
               const Mark& mark, Layer& layer) {
  const Projected a = camera.project(mark.from);
  const Projected b = camera.project(mark.to);
  if (!std::isfinite(a.x + a.y + b.x + b.y) || a.depth <= 0 || b.depth <= 0) return;
  const float pixels = std::hypot(b.x - a.x, b.y - a.y);
  const int dots = std::min(kMaxDots, 1 + static_cast<int>(std::ceil(pixels / kStep)));
  for (int i = 0; i < dots; ++i) {
    const float share = dots == 1 ? 0 : static_cast<float>(i) / static_cast<float>(dots - 1);
    const Vec3 at = mix(mark.from, mark.to, share);
    const Vec3 way = at - camera.eye();
    const bool is_hidden = subject.scene.is_occluded(ray::Ray{camera.eye(), way, 0, 1 - kNear});
    draw_dot(image, layer, camera.project(at), mark.width / 2, is_hidden ? kHidden : 1,
             mark.rrggbb);
  }
}

}  // namespace

void draw_marks(const RenderSubject& subject, const Camera& camera, Image& image) {
  if (subject.palette.marks.empty()) return;
  const auto count =
      static_cast<std::size_t>(image.width()) * static_cast<std::size_t>(image.height());
  Layer layer{std::vector<float>(count), std::vector<std::uint32_t>(count)};
  for (const Mark& mark : subject.palette.marks) draw_mark(subject, camera, image, mark, layer);
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      const auto i = static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width()) +
                     static_cast<std::size_t>(x);
      if (layer.strength[i] == 0) continue;
      image.at(x, y) = mix(image.at(x, y), linear_colour(layer.rrggbb[i]), layer.strength[i]);
    }
  }
}

}  // namespace hedgerow::tool
