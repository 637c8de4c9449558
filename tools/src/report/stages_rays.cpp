#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "hedgerow/circulate.h"
#include "hedgerow/normals.h"
#include "hedgerow/ray/surface.h"
#include "render/camera.h"
#include "report/rays.h"
#include "report/reference_rays.h"
#include "report/timing.h"

namespace hedgerow::tool {
namespace {

constexpr int kWidth = 1280;
constexpr int kHeight = 720;
constexpr int kTile = 8;         // a packet is a row of a tile of pixels
constexpr float kReach = 0.05F;  // of the diagonal: how far occlusion rays look
constexpr std::int64_t kRayBytes = 32;
constexpr std::int64_t kHitBytes = sizeof(ray::Hit);
constexpr std::int64_t kIndex = sizeof(Index);
constexpr std::int64_t kVector = 3 * sizeof(float);

using Packets = std::vector<ray::RayPacket>;

/// Rays through the middle of every pixel, tile by tile, eight neighbours in a packet.
Packets primary_rays(const Camera& camera) {
  Packets packets;
  for (int top = 0; top < kHeight; top += kTile) {
    for (int left = 0; left < kWidth; left += kTile) {
      for (int y = top; y < top + kTile; ++y) {
        ray::RayPacket& packet = packets.emplace_back();
        for (int i = 0; i < kTile; ++i) {
          const Vec3 way =
              camera.direction(static_cast<float>(left + i) + 0.5F, static_cast<float>(y) + 0.5F);
          packet.set(static_cast<std::size_t>(i), {camera.eye(), way});
        }
      }
    }
  }
  return packets;
}

ray::Ray ray_of(const Packets& packets, std::size_t number) {
  const ray::RayPacket& packet = packets[number / 8];
  const std::size_t lane = number % 8;
  ray::Ray ray;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    ray.origin[axis] = packet.origin[axis][lane];
    ray.direction[axis] = packet.direction[axis][lane];
  }
  ray.near = packet.near[lane];
  ray.far = packet.far[lane];
  return ray;
}

/// Fractions from a number, always the same: Weyl's sequences, which fill a square evenly.
float fraction(std::uint32_t number, std::uint32_t step) {
  return static_cast<float>((number * step) >> 8U) / 16777216.0F;
}

/// Calls `body(begin, end)` for parts of [0, count), on the threads of the execution.
template <class Body>
void for_parts(Run& run, const Execution& execution, std::size_t count, const Body& body) {
  if (execution.threads() == 1) {
    body(std::size_t{0}, count);
    return;
  }
  run.in_arena([&] {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 256),
                      [&](const tbb::blocked_range<std::size_t>& r) { body(r.begin(), r.end()); });
  });
}

/// What a shader asks the mesh at every hit.
struct Answer {
  Vec3 normal{};
  std::uint32_t ring = 0;  ///< sum of the neighbours of the nearest vertex, modulo 2^32
};

class RayStages {
 public:
  RayStages(Stages& stages, const Subject& subject)
      : stages_(stages),
        subject_(subject),
        xyz_(Buffer<float>::copy_of(subject.soup.xyz.span())),
        points_(points_of(subject)),
        camera_(points_, kWidth, kHeight),
        packets_(primary_rays(camera_)),
        hits_(packets_.size()),
        reference_(subject.soup, subject.soup.xyz) {}

  RayFacts measure() {
    Result<ray::Device> device = ray::Device::create();
    if (!device) {
      stages_.fail("ray_library");
      return {};
    }
    facts_.embree_version = device->version();
    facts_.width = kWidth;
    facts_.height = kHeight;
    facts_.brute_force_rays = reference_.knows_all_faces() ? reference_.affordable_rays() : 0;
    measure_build(*device, ray::Motion::still, "still");
    measure_build(*device, ray::Motion::moving, "moving");
    measure_refit(*device);
    const auto scene = build(*device, ray::Motion::still, Execution::serial());
    if (!scene) return facts_;
    facts_.copied_index_bytes = static_cast<std::int64_t>(scene->stats().copied_bytes);
    facts_.tree_bytes = device->held_bytes();
    measure_primary(*scene);
    measure_occlusion(*scene);
    measure_connectivity(*scene);
    return facts_;
  }

 private:
  static std::vector<Vec3> points_of(const Subject& subject) {
    std::vector<Vec3> points;
    for (const Index v : subject.soup.corners)
      points.push_back(to_vector(subject.soup.positions()[v]));
    return points;
  }
  Result<ray::Scene> build(const ray::Device& device, ray::Motion motion,
                           const Execution& execution) const {
    return ray::Scene::build(device, subject_.mesh, ray::PaddedPositions::of(xyz_),
                             {.motion = motion}, execution);
  }
  Stage stage(const char* name, const char* variant, std::int64_t elements, const char* unit,
              std::int64_t bytes) const {
    Stage stage{.name = name, .variant = variant};
    stage.elements = elements;
    stage.unit = unit;
    stage.bytes = bytes;
    stage.mix = Mix::read;
    return stage;
  }
  std::int64_t face_bytes() const {
    return kIndex * subject_.halfedges() + kVector * subject_.vertices();
  }

  /// A sample of the primary rays, spread over the picture.
  bool agrees(const ray::Scene& scene, const ReferenceRays& reference) const {
    const std::size_t count = 8 * packets_.size();
    const std::size_t step = count / static_cast<std::size_t>(facts_.brute_force_rays) + 1;
    for (std::size_t i = step / 2; i < count; i += step) {
      const ray::Ray ray = ray_of(packets_, i);
      if (!reference.accepts(ray, scene.intersect(ray))) return false;
    }
    return true;
  }

  /// Larger faces have no reference: their stages say that they are not checked.
  [[nodiscard]] Stages::Check if_known(Stages::Check check) const {
    return reference_.knows_all_faces() ? std::move(check) : Stages::Check();
  }

  void measure_build(const ray::Device& device, ray::Motion motion, const char* variant) {
    stages_.measure(stage("bvh_build", variant, subject_.faces(), "face", face_bytes()),
                    if_known([&](const Execution& execution) {
                      const auto scene = build(device, motion, execution);
                      return scene && agrees(*scene, reference_);
                    }),
                    [&](const Execution& execution) { (void)build(device, motion, execution); });
  }

  void measure_refit(const ray::Device& device) {
    auto scene = build(device, ray::Motion::moving, Execution::serial());
    if (!scene) return;
    // One per cent away from where they were, so that an unfitted tree would show.
    for (float& coordinate : xyz_) coordinate *= 1.01F;
    const ReferenceRays moved(subject_.soup, xyz_);
    stages_.measure(stage("bvh_refit", "whole", subject_.faces(), "face", face_bytes()),
                    if_known([&](const Execution& execution) {
                      return scene->refit(execution).has_value() && !scene->has_built() &&
                             agrees(*scene, moved);
                    }),
                    [&](const Execution& execution) { (void)scene->refit(execution); });
    std::copy(subject_.soup.xyz.begin(), subject_.soup.xyz.end(), xyz_.begin());
  }

  void measure_primary(const ray::Scene& scene) {
    const auto work = [&](const Execution& execution) {
      for_parts(stages_.run(), execution, packets_.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) hits_[i] = scene.intersect(packets_[i]);
      });
    };
    const auto count = static_cast<std::int64_t>(8 * packets_.size());
    stages_.measure(
        stage("rays_primary", "8 at a time", count, "ray", count * (kRayBytes + kHitBytes)),
        if_known([&](const Execution& execution) {
          work(execution);
          return agrees(scene, reference_) && packets_agree(scene);
        }),
        work);
    facts_.primary_rays = count;
    for (const ray::HitPacket& packet : hits_) {
      facts_.primary_hits += std::ranges::count_if(packet, &ray::Hit::valid);
    }
  }

  /// Every ray by itself meets what it met among eight.
  bool packets_agree(const ray::Scene& scene) const {
    std::int64_t different = 0;
    for (std::size_t i = 0; i < 8 * packets_.size(); i += 7) {
      const ray::Hit& among = hits_[i / 8][i % 8];
      const ray::Hit alone = scene.intersect(ray_of(packets_, i));
      const bool is_same = among.valid() == alone.valid() &&
                           (!alone.valid() || std::abs(among.t - alone.t) <= 2e-4F * alone.t);
      different += is_same ? 0 : 1;
    }
    // Embree's two ways may differ where a ray passes along a silhouette.
    return different * 10000 <= static_cast<std::int64_t>(8 * packets_.size());
  }

  void measure_occlusion(const ray::Scene& scene) {
    const Packets rays = occlusion_rays(scene);
    if (rays.empty()) return;
    std::vector<ray::OccludedPacket> found(rays.size());
    const auto work = [&](const Execution& execution) {
      for_parts(stages_.run(), execution, rays.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
          found[i] = scene.is_occluded(rays[i], ray::Coherence::incoherent);
        }
      });
    };
    const auto count = static_cast<std::int64_t>(8 * rays.size());
    stages_.measure(stage("rays_occlusion", "8 at a time", count, "ray", count * (kRayBytes + 1)),
                    if_known([&](const Execution& execution) {
                      work(execution);
                      return occlusion_agrees(rays, found);
                    }),
                    work);
    facts_.occlusion_rays = count;
    for (const ray::OccludedPacket& packet : found) {
      facts_.occluded += std::ranges::count(packet, true);
    }
  }

  bool occlusion_agrees(const Packets& rays, const std::vector<ray::OccludedPacket>& found) const {
    const std::size_t step =
        8 * rays.size() / static_cast<std::size_t>(facts_.brute_force_rays) + 1;
    for (std::size_t i = step / 2; i < 8 * rays.size(); i += step) {
      if (!reference_.accepts(ray_of(rays, i), found[i / 8][i % 8])) return false;
    }
    return true;
  }

  /// One ray from each hit, spread by the cosine round the normal of the face, in packets.
  Packets occlusion_rays(const ray::Scene& scene) const {
    Packets rays;
    std::uint32_t number = 0;
    for (std::size_t i = 0; i < 8 * packets_.size(); ++i) {
      const ray::Hit& hit = hits_[i / 8][i % 8];
      if (!hit.valid()) continue;
      const ray::Ray from = ray_of(packets_, i);
      if (number % 8 == 0) rays.emplace_back().count = 0;
      rays.back().set(number % 8, bounce(scene, from, hit, number));
      rays.back().count = static_cast<int>(number % 8 + 1);
      ++number;
    }
    if (number % 8 != 0) rays.pop_back();  // whole packets only: counts are multiples of 8
    return rays;
  }

  ray::Ray bounce(const ray::Scene& scene, const ray::Ray& from, const ray::Hit& hit,
                  std::uint32_t number) const {
    const auto triangle = scene.primitives().point(hit).corners;
    std::array<Vec3, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto h = static_cast<std::size_t>(triangle[k].value);
      corners[k] = to_vector(subject_.soup.positions()[subject_.mesh.origin()[h]]);
    }
    Vec3 normal = unit(cross(corners[1] - corners[0], corners[2] - corners[0]));
    if (dot(normal, from.direction) > 0) normal = normal * -1.0F;
    const Vec3 tangent =
        unit(cross(normal, std::abs(normal[0]) < 0.6F ? Vec3{1, 0, 0} : Vec3{0, 1, 0}));
    const float squared = fraction(number + 1, 3242174889U);
    const float angle = 6.2831853F * fraction(number + 1, 2447445414U);
    const Vec3 way = tangent * (std::sqrt(squared) * std::cos(angle)) +
                     cross(normal, tangent) * (std::sqrt(squared) * std::sin(angle)) +
                     normal * std::sqrt(1 - squared);
    const Vec3 at = from.origin + from.direction * hit.t + normal * (1e-4F * camera_.diagonal());
    return {at, way, 0, kReach * camera_.diagonal()};
  }

  void measure_connectivity(const ray::Scene& scene);

  Stages& stages_;
  const Subject& subject_;
  Buffer<float> xyz_;
  std::vector<Vec3> points_;
  Camera camera_;
  Packets packets_;
  std::vector<ray::HitPacket> hits_;
  ReferenceRays reference_;
  RayFacts facts_;
};

/// The same question to the pointer-based mesh; it sees one fan of a vertex.
Answer ask(const baselines::PointerHalfedgeMesh& mesh, const ray::SurfacePoint& point) {
  Answer answer;
  for (std::size_t k = 0; k < 3; ++k) {
    const float* normal = mesh.halfedge(point.corners[k].value).vertex->normal;
    answer.normal = answer.normal + to_vector(normal) * point.weights[k];
  }
  answer.normal = unit(answer.normal);
  const auto* vertex = mesh.halfedge(point.corners[ray::nearest_corner(point)].value).vertex;
  const auto* start = vertex->halfedge;
  if (start->prev->opposite == nullptr) {
    answer.ring += static_cast<std::uint32_t>(start->prev->vertex->id);
  }
  const auto* h = start;
  do {
    answer.ring += static_cast<std::uint32_t>(h->next->vertex->id);
    h = h->opposite != nullptr ? h->opposite->next : nullptr;
  } while (h != nullptr && h != start);
  return answer;
}

template <Topology Mesh>
Answer ask(const Mesh& mesh, const ray::SurfacePoint& point, Positions normals) {
  Answer answer;
  answer.normal = ray::interpolate_normal(mesh, point, normals);
  for (const VertexId u : neighbours(mesh, ray::nearest_vertex(mesh, point))) {
    answer.ring += static_cast<std::uint32_t>(u.value);
  }
  return answer;
}

void RayStages::measure_connectivity(const ray::Scene& scene) {
  std::vector<ray::SurfacePoint> points;
  for (const ray::HitPacket& packet : hits_) {
    for (const ray::Hit& hit : packet) {
      if (hit.valid()) points.push_back(scene.primitives().point(hit));
    }
  }
  if (points.empty()) return;
  subject_.pointer.compute_face_normals();
  subject_.pointer.compute_vertex_normals(NormalWeight::area);
  const std::vector<float> normals = subject_.pointer.vertex_normals();
  const Positions normals_view{normals.data(), subject_.vertices()};
  const std::vector<std::uint32_t> sums = subject_.reference.neighbour_sums();
  std::vector<Answer> answers(points.size());
  const auto work = [&](const Execution& execution) {
    subject_.mesh.visit([&](const auto& view) {
      for_parts(stages_.run(), execution, points.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) answers[i] = ask(view, points[i], normals_view);
      });
    });
  };
  const auto is_right = [&](std::size_t i) {
    const ray::SurfacePoint& point = points[i];
    const auto v_of = [&](std::size_t k) {
      return subject_.mesh.origin()[static_cast<std::size_t>(point.corners[k].value)];
    };
    Vec3 sum{};
    for (std::size_t k = 0; k < 3; ++k) {
      sum = sum + to_vector(normals_view[v_of(k)]) * point.weights[k];
    }
    const auto nearest = static_cast<std::size_t>(v_of(ray::nearest_corner(point)));
    return answers[i].ring == sums[nearest] && length(answers[i].normal - unit(sum)) < 1e-4F;
  };
  Stage measured = stage("hit_connectivity", "normal and one-ring", std::ssize(points), "hit",
                         std::ssize(points) * (kIndex * (3 + 2 * 6) + 4 * kVector));
  std::uint32_t sink = 0;
  measured.pointer_ms = time_median([&] {
                          for (const auto& point : points)
                            sink += ask(subject_.pointer, point).ring;
                        }).ms;
  answers.front().ring = sink;  // or the compiler would leave the work out
  stages_.measure(
      std::move(measured),
      [&](const Execution& execution) {
        std::ranges::fill(answers, Answer{});
        work(execution);
        for (std::size_t i = 0; i < points.size(); ++i) {
          if (!is_right(i)) return false;
        }
        return true;
      },
      work);
}

}  // namespace

RayFacts measure_rays(Stages& stages, const Subject& subject) {
  return RayStages(stages, subject).measure();
}

}  // namespace hedgerow::tool
