#include "render/renderer.h"

#include <algorithm>
#include <cmath>

#include <tbb/blocked_range2d.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>

#include "hedgerow/circulate.h"
#include "hedgerow/query.h"
#include "hedgerow/ray/surface.h"
#include "render/light.h"
#include "render/occlusion.h"

namespace hedgerow::tool {
namespace {

// Eight places in a pixel, each alone in its row and in its column.
constexpr std::array<std::array<float, 2>, 8> kSamples = {{{0.0625F, 0.4375F},
                                                           {0.1875F, 0.9375F},
                                                           {0.3125F, 0.1875F},
                                                           {0.4375F, 0.6875F},
                                                           {0.5625F, 0.3125F},
                                                           {0.6875F, 0.8125F},
                                                           {0.8125F, 0.0625F},
                                                           {0.9375F, 0.5625F}}};
constexpr int kTile = 16;           // pixels: rays of a tile stay in one part of the mesh
constexpr float kReach = 0.22F;     // of the diagonal: what is further away darkens nothing
constexpr float kLineWidth = 1.1F;  // pixels
constexpr float kFadeFrom = 10;     // pixels an edge is long where its line is drawn in full,
constexpr float kFadeTo = 2;        // and where it is not drawn at all

const Vec3 kInside = {0.42F, 0.17F, 0.13F};  // the side of a face that its normal points away from
const Vec3 kLine = {0.012F, 0.016F, 0.024F};
const Vec3 kRim = {0.01F, 0.16F, 0.24F};  // lines along the boundary

/// One hit, in full.
struct Sample {
  ray::SurfacePoint point;
  Vec3 at{};
  Vec3 view{};  // to the eye
  Vec3 face{};  // normal of the face, to the side of its own
  bool is_back = false;
};

template <Topology Mesh>
class Painter {
 public:
  Painter(const Mesh& mesh, const RenderSubject& subject, const Camera& camera,
          const RenderOptions& options)
      : mesh_(mesh),
        subject_(subject),
        camera_(camera),
        options_(options),
        light_(camera),
        primitives_(subject.scene.primitives()),
        positions_{subject.xyz.data(), mesh.vertex_count()},
        normals_{subject.normals.data(), mesh.vertex_count()},
        occlusion_(subject.scene, kReach * camera.diagonal(), (options.ao_rays + 7) / 8) {}

  [[nodiscard]] Vec3 pixel(int x, int y) const {
    ray::RayPacket packet;
    for (std::size_t i = 0; i < 8; ++i) {
      packet.set(i, {camera_.eye(), camera_.direction(static_cast<float>(x) + kSamples[i][0],
                                                      static_cast<float>(y) + kSamples[i][1])});
    }
    const ray::HitPacket hits = subject_.scene.intersect(packet);
    Vec3 sum{};
    for (std::size_t i = 0; i < 8; ++i) {
      const Vec3 way = {packet.direction[0][i], packet.direction[1][i], packet.direction[2][i]};
      // Wraps round in pictures of 2^29 pixels and more: seeds may come twice.
      const auto seed = static_cast<std::uint32_t>((std::int64_t{y} * options_.width + x) * 8 +
                                                   static_cast<std::int64_t>(i));
      const float px = static_cast<float>(x) + kSamples[i][0];
      const float py = static_cast<float>(y) + kSamples[i][1];
      sum = sum + (hits[i].valid() ? surface(hits[i], way, px, py, seed)
                                   : surroundings(way, px, py, seed));
    }
    return sum * 0.125F;
  }

 private:
  [[nodiscard]] Vec3 surface(const ray::Hit& hit, const Vec3& way, float px, float py,
                             std::uint32_t seed) const {
    Sample sample;
    sample.point = primitives_.point(hit);
    sample.at = interpolate(mesh_, sample.point, positions_);
    sample.view = way * -1.0F;
    const Vec3 a = corner(sample.point, 0);
    sample.face = unit(cross(corner(sample.point, 1) - a, corner(sample.point, 2) - a));
    sample.is_back = dot(sample.face, sample.view) < 0;
    const Vec3 normal = shading_normal(sample);
    Vec3 colour = colour_of(sample, normal);
    if (options_.wireframe) colour = with_lines(colour, sample, px, py);
    const Vec3 to_eye = sample.is_back ? normal * -1.0F : normal;
    float open = 1;
    if (options_.ao_rays > 0) {
      open = occlusion_.open_share(sample.at, sample.is_back ? sample.face * -1.0F : sample.face,
                                   seed);
    }
    if (subject_.palette.shading == Shading::normals) return colour * (0.4F + 0.6F * open);
    return light_.shade(colour, to_eye, sample.view, open);
  }

  [[nodiscard]] Vec3 corner(const ray::SurfacePoint& point, std::size_t k) const {
    return to_vector(positions_[mesh_.origin[point.corners[k]].value]);
  }

  [[nodiscard]] Vec3 shading_normal(const Sample& sample) const {
    if (subject_.palette.shading == Shading::flat) return sample.face;
    const Vec3 smooth = ray::interpolate_normal(mesh_, sample.point, normals_);
    // Where normals cancel, or point to the far side of the face, the face's own is better.
    return dot(smooth, sample.face) > 0.05F ? smooth : sample.face;
  }

  [[nodiscard]] Vec3 colour_of(const Sample& sample, const Vec3& normal) const {
    const Palette& palette = subject_.palette;
    if (palette.shading == Shading::normals) return (normal + Vec3{1, 1, 1}) * 0.5F;
    if (!palette.of_vertex.empty()) {
      const VertexId v = ray::nearest_vertex(mesh_, sample.point);
      return palette.colours[palette.of_vertex[static_cast<std::size_t>(v.value)]];
    }
    if (!palette.of_face.empty()) {
      const FaceId f = ray::face_of(mesh_, sample.point);
      return palette.colours[palette.of_face[static_cast<std::size_t>(f.value)]];
    }
    return sample.is_back ? kInside : palette.plain;
  }

  /// Lines along the half-edges of the face that was met: those of the neighbour draw their other
  /// half. Diagonals of quads and polygons have no half-edge, so no line.
  [[nodiscard]] Vec3 with_lines(const Vec3& colour, const Sample& sample, float px,
                                float py) const {
    float strongest = 0;
    bool is_rim = false;
    for (const HalfedgeId h : halfedges(mesh_, ray::face_of(mesh_, sample.point))) {
      const Projected a = camera_.project(to_vector(positions_[mesh_.origin[h].value]));
      const Projected b = camera_.project(to_vector(positions_[mesh_.target(h).value]));
      const float dx = b.x - a.x;
      const float dy = b.y - a.y;
      const float squared = dx * dx + dy * dy;
      const float along =
          squared > 0 ? std::clamp(((px - a.x) * dx + (py - a.y) * dy) / squared, 0.0F, 1.0F) : 0;
      const float off = std::hypot(px - a.x - along * dx, py - a.y - along * dy);
      const bool is_on_rim = is_boundary_edge(mesh_, h);
      const float width = is_on_rim ? 2 * kLineWidth : kLineWidth / 2;
      const float size = std::sqrt(squared);
      const float fade = std::clamp((size - kFadeTo) / (kFadeFrom - kFadeTo), 0.0F, 1.0F);
      const float strength = std::clamp(width + 0.5F - off, 0.0F, 1.0F) * fade;
      if (strength > strongest) {
        strongest = strength;
        is_rim = is_on_rim;
      }
    }
    return mix(colour, is_rim ? kRim : kLine, 0.85F * strongest);
  }

  /// Paper, brighter in the middle, with the shadow of the mesh on a floor that is not seen itself.
  [[nodiscard]] Vec3 surroundings(const Vec3& way, float px, float py, std::uint32_t seed) const {
    const float dx = px / static_cast<float>(options_.width) - 0.5F;
    const float dy = py / static_cast<float>(options_.height) - 0.42F;
    const Vec3 paper = mix(Vec3{0.91F, 0.92F, 0.93F}, Vec3{0.56F, 0.60F, 0.66F},
                           std::min(1.0F, 1.5F * (dx * dx + dy * dy)));
    if (options_.ao_rays == 0) return paper;
    const Vec3& up = camera_.world_up();
    const float fall = dot(way, up);
    const float above = dot(camera_.eye(), up) - camera_.floor();
    if (fall >= -1e-4F || above <= 0) return paper;
    const Vec3 at = camera_.eye() + way * (above / -fall);
    const float far = length(at - camera_.centre()) / camera_.diagonal();
    if (far > 1.2F) return paper;
    const float closed = 1 - occlusion_.open_share(at, up, seed);
    return paper * (1 - 0.6F * closed * (1 - far / 1.2F));
  }

  const Mesh& mesh_;
  const RenderSubject& subject_;
  const Camera& camera_;
  const RenderOptions& options_;
  Light light_;
  ray::PrimitiveMap primitives_;
  Positions positions_;
  Positions normals_;
  Occlusion occlusion_;
};

}  // namespace

Image render(Run& run, const RenderSubject& subject, const Camera& camera,
             const RenderOptions& options) {
  Image image(options.width, options.height);
  subject.mesh.visit([&](const auto& view) {
    const Painter painter(view, subject, camera, options);
    run.in_arena([&] {
      const tbb::blocked_range2d<int> tiles(0, options.height, kTile, 0, options.width, kTile);
      tbb::parallel_for(
          tiles,
          [&](const tbb::blocked_range2d<int>& tile) {
            for (int y = tile.rows().begin(); y < tile.rows().end(); ++y) {
              for (int x = tile.cols().begin(); x < tile.cols().end(); ++x) {
                image.at(x, y) = painter.pixel(x, y);
              }
            }
          },
          tbb::simple_partitioner());
    });
  });
  return image;
}

}  // namespace hedgerow::tool
