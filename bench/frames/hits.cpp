// What a shader asks the mesh at a hit. One thread: threads scale by cutting up the hits.
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>
#include <random>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "baselines/pointer_mesh.h"
#include "frames/edge_hash.h"
#include "frames/rays.h"
#include "frames/stages.h"
#include "hedgerow/build.h"
#include "hedgerow/circulate.h"
#include "hedgerow/normals.h"
#include "hedgerow/query.h"
#include "hedgerow/ray/near.h"
#include "hedgerow/ray/surface.h"
#include "peers/measured_mesh.h"

namespace hedgerow::bench {
namespace {

using ray::SurfacePoint;
using ray::Vec3;

constexpr std::size_t kBatch = 256;    // hits between two looks at the clock
constexpr std::size_t kSome = 50'000;  // hits that wider searches are measured on
constexpr int kWalkSteps = 50;

struct HitOrder {
  const char* name;
  std::vector<ray::Hit> hits;
  std::vector<SurfacePoint> points;  ///< of the hits
};

/// The first `limit` of them.
template <class Value>
std::span<const Value> first(const std::vector<Value>& values, std::size_t limit) {
  return std::span(values).first(std::min(limit, values.size()));
}

class HitStages {
 public:
  HitStages(Rows& rows, const Subject& subject, const FrameOptions& options)
      : rows_(rows), subject_(subject), options_(options), normals_(subject.soup.xyz.size()) {
    Workspace workspace;
    (void)gather_vertex_normals(subject.mesh, subject.soup.positions(),
                                {normals_.data(), subject.vertices()}, {}, Execution::serial(),
                                workspace);
    make_orders();
  }

  void measure() {
    subject_.mesh.visit([&](const auto& view) {
      for (const HitOrder& order : orders_) measure_ours(view, order);
    });
    for (const HitOrder& order : orders_) measure_raw(order);
    measure_build();
    if (subject_.soup.offsets.empty()) measure_hash();
    measure_pointers();
    measure_peers();
  }

 private:
  [[nodiscard]] Positions normals() const { return {normals_.data(), subject_.vertices()}; }

  void make_orders() {
    scene_.emplace(std::move(*ray::Scene::build(*ray::Device::create(), subject_.mesh,
                                                ray::PaddedPositions::of(subject_.soup.xyz), {},
                                                Execution::serial())));
    const auto trace = [&](const Packets& packets) {
      std::vector<ray::HitPacket> hits(packets.size());
      for (std::size_t i = 0; i < packets.size(); ++i) hits[i] = scene_->intersect(packets[i]);
      return hits;
    };
    const auto met = [](const std::vector<ray::HitPacket>& packets) {
      std::vector<ray::Hit> hits;
      for (const ray::HitPacket& packet : packets) {
        std::ranges::copy_if(packet, std::back_inserter(hits), &ray::Hit::valid);
      }
      return hits;
    };
    const Packets primary = primary_rays(subject_, options_.still_rays);
    const auto packets = trace(primary);
    std::vector<ray::Hit> hits = met(packets);
    add_order("coherent", hits);
    add_order("bounce", met(trace(scattered_rays(subject_, *scene_, primary, packets, 1, 10))));
    std::mt19937_64 random(5);
    for (std::size_t i = hits.size(); i > 1; --i) std::swap(hits[i - 1], hits[random() % i]);
    add_order("shuffled", hits);
    if (orders_.empty()) rows_.fail("S5: no ray met anything");
  }

  void add_order(const char* name, const std::vector<ray::Hit>& hits) {
    if (hits.empty()) return;
    HitOrder& order = orders_.emplace_back(HitOrder{name, hits, {}});
    for (const ray::Hit& hit : hits) order.points.push_back(scene_->primitives().point(hit));
  }

  /// Measures `ask(value, sum)` of hits, or of points of the surface.
  template <class Value, class Ask>
  HitSum measure_ask(const std::string& what, const char* variant, std::span<const Value> values,
                     const Ask& ask) {
    HitSum sum;
    std::vector<double> batches;
    double best = 1e300;
    for (int run = 0; run <= options_.runs; ++run) {
      sum = {};
      batches.clear();
      const double start = now_ms();
      double last = start;
      for (std::size_t begin = 0; begin < values.size(); begin += kBatch) {
        const std::size_t end = std::min(begin + kBatch, values.size());
        for (std::size_t i = begin; i < end; ++i) ask(values[i], sum);
        const double now = now_ms();
        batches.push_back((now - last) * 1e6 / static_cast<double>(end - begin));
        last = now;
      }
      if (run > 0) best = std::min(best, last - start);
    }
    sink_ = sink_ + static_cast<double>(sum.ring) + sum.normal;
    rows_.add({"S5", what, variant, best * 1e6 / static_cast<double>(values.size()), "ns/hit",
               fmt::format("{} hits, p99 of batches {:.0f} ns", values.size(),
                           percentile(batches, 0.99))});
    return sum;
  }

  template <Topology Mesh>
  void measure_ours(const Mesh& mesh, const HitOrder& order) {
    const auto add_ring = [&](const SurfacePoint& point, HitSum& sum) {
      for (const VertexId u : neighbours(mesh, ray::nearest_vertex(mesh, point))) {
        sum.ring += static_cast<std::uint32_t>(u.value);
      }
    };
    const std::string in_order = fmt::format(", {}", order.name);
    const auto all = std::span<const SurfacePoint>(order.points);
    (void)measure_ask("normal" + in_order, "hedgerow", all,
                      [&](const SurfacePoint& point, HitSum& sum) {
                        add_unit_normal(ray::interpolate_normal(mesh, point, normals()), sum);
                      });
    (void)measure_ask("one-ring" + in_order, "hedgerow", all, add_ring);
    // From the hit as the ray tracer gives it: the way to the half-edges is a part of the answer.
    const ray::PrimitiveMap primitives = scene_->primitives();
    expected_.push_back(
        measure_ask("normal and one-ring" + in_order, "hedgerow",
                    std::span<const ray::Hit>(order.hits), [&](const ray::Hit& hit, HitSum& sum) {
                      const SurfacePoint point = primitives.point(hit);
                      add_unit_normal(ray::interpolate_normal(mesh, point, normals()), sum);
                      add_ring(point, sum);
                    }));
    measure_wider(mesh, order);
  }

  /// What reaches further than the one-ring.
  template <Topology Mesh>
  void measure_wider(const Mesh& mesh, const HitOrder& order) {
    const std::string in_order = fmt::format(", {}", order.name);
    const Positions positions = subject_.soup.positions();
    const auto add_count = [](std::size_t count, HitSum& sum) {
      sum.ring += static_cast<std::uint32_t>(count);
    };
    (void)measure_ask("two-ring" + in_order, "hedgerow", first(order.points, kSome),
                      [&](const SurfacePoint& point, HitSum& sum) {
                        const VertexId centre = ray::nearest_vertex(mesh, point);
                        add_count(search_.k_ring(mesh, centre, 2).size(), sum);
                      });
    const float radius = 0.01F * subject_.diagonal;
    (void)measure_ask("ball of 1% of the diagonal" + in_order, "hedgerow",
                      first(order.points, kSome / 50), [&](const SurfacePoint& point, HitSum& sum) {
                        add_count(search_.geodesic_ball(mesh, positions, point, radius).size(),
                                  sum);
                      });
    (void)measure_ask("walk of 50 edges" + in_order, "hedgerow", first(order.points, kSome / 10),
                      [&](const SurfacePoint& point, HitSum& sum) {
                        std::array<VertexId, kWalkSteps> steps;
                        const VertexId start = ray::nearest_vertex(mesh, point);
                        add_count(ray::edge_walk(mesh, positions, start, {1, 0, 0}, steps), sum);
                      });
    (void)measure_ask("on the boundary" + in_order, "hedgerow",
                      std::span<const SurfacePoint>(order.points),
                      [&](const SurfacePoint& point, HitSum& sum) {
                        add_count(is_boundary(mesh, ray::nearest_vertex(mesh, point)) ? 1 : 0, sum);
                      });
  }

  /// Embree's user with index arrays alone: normals, but no neighbours.
  void measure_raw(const HitOrder& order) {
    const Index* corners = subject_.soup.corners.data();
    (void)measure_ask(fmt::format("normal, {}", order.name), "raw index arrays",
                      std::span<const SurfacePoint>(order.points),
                      [&](const SurfacePoint& point, HitSum& sum) {
                        Vec3 normal{};
                        for (std::size_t k = 0; k < 3; ++k) {
                          const float* at = normals()[corners[point.corners[k].value]];
                          for (std::size_t axis = 0; axis < 3; ++axis) {
                            normal[axis] += point.weights[k] * at[axis];
                          }
                        }
                        add_normal(normal, sum);
                      });
  }

  /// Both parts of an answer have to agree: rings to the bit, normals but for the order of sums.
  void compare(const char* who, std::size_t order, const HitSum& sum) {
    const HitSum& ours = expected_[order];
    const double slack = 1e-5 * static_cast<double>(orders_[order].hits.size());
    // A vertex with several fans shows one of them to the others.
    const bool is_ring_right = sum.ring == ours.ring || !subject_.mesh.fans().empty();
    if (is_ring_right && std::abs(sum.normal - ours.normal) <= slack) return;
    rows_.fail(fmt::format("S5 normal and one-ring, {}: {}", orders_[order].name, who));
  }

  void measure_build() {
    BuildOptions options;
    options.borrow_corners = true;
    const double start = now_ms();
    const auto built = build(subject_.soup.face_list(), options, Execution::serial());
    add_conversion("hedgerow", now_ms() - start);
    if (!built) rows_.fail("S0: a build failed");
  }

  void measure_hash() {
    const double start = now_ms();
    const EdgeHash hash(subject_.soup);
    add_conversion("edge hash map", now_ms() - start);
    const TriangleView view = subject_.mesh.triangles();
    for (std::size_t i = 0; i < orders_.size(); ++i) {
      const HitSum sum =
          measure_ask(fmt::format("normal and one-ring, {}", orders_[i].name), "edge hash map",
                      std::span<const SurfacePoint>(orders_[i].points),
                      [&](const SurfacePoint& point, HitSum& out) {
                        add_unit_normal(ray::interpolate_normal(view, point, normals()), out);
                        out.ring += hash.ring_sum(point.corners[ray::nearest_corner(point)].value);
                      });
      compare("edge hash map", i, sum);
    }
  }

  void measure_pointers() {
    const double begin = now_ms();
    baselines::PointerHalfedgeMesh pointer(subject_.soup.face_list(), subject_.soup.positions());
    add_conversion("pointer half-edge", now_ms() - begin);
    for (Index v = 0; v < subject_.mesh.vertex_count(); ++v) {
      std::copy_n(normals()[v], 3, pointer.vertex(v).normal);
    }
    const auto ask = [&](const SurfacePoint& point, HitSum& out) {
      Vec3 normal{};
      for (std::size_t k = 0; k < 3; ++k) {
        const float* at = pointer.halfedge(point.corners[k].value).vertex->normal;
        for (std::size_t axis = 0; axis < 3; ++axis) normal[axis] += point.weights[k] * at[axis];
      }
      add_normal(normal, out);
      const auto* start =
          pointer.halfedge(point.corners[ray::nearest_corner(point)].value).vertex->halfedge;
      if (start->prev->opposite == nullptr) {
        out.ring += static_cast<std::uint32_t>(start->prev->vertex->id);
      }
      const auto* h = start;
      do {
        out.ring += static_cast<std::uint32_t>(h->next->vertex->id);
        h = h->opposite != nullptr ? h->opposite->next : nullptr;
      } while (h != nullptr && h != start);
    };
    for (std::size_t i = 0; i < orders_.size(); ++i) {
      const auto points = std::span<const SurfacePoint>(orders_[i].points);
      compare("pointer half-edge", i,
              measure_ask(fmt::format("normal and one-ring, {}", orders_[i].name),
                          "pointer half-edge", points, ask));
    }
  }

  void measure_peers() {
    for (const Peer& peer : peers()) {
      if (peer.is_baseline) continue;
      const double start = now_ms();
      const auto mesh = peer.build(subject_.soup.face_list(), subject_.soup.positions());
      if (mesh == nullptr) continue;
      add_conversion(peer.name, now_ms() - start);
      mesh->set_vertex_normals(normals());
      for (std::size_t i = 0; i < orders_.size(); ++i) {
        const std::vector<HitQuestion> questions = questions_of(orders_[i]);
        HitSum sum;
        const double ms = best_ms(options_.runs, [&] { sum = mesh->answer_hits(questions); });
        rows_.add({"S5", fmt::format("normal and one-ring, {}", orders_[i].name), peer.name,
                   ms * 1e6 / static_cast<double>(questions.size()), "ns/hit",
                   fmt::format("{} hits", questions.size())});
        compare(peer.name, i, sum);
      }
    }
  }

  [[nodiscard]] std::vector<HitQuestion> questions_of(const HitOrder& order) const {
    std::vector<HitQuestion> questions;
    const auto vertex = [&](HalfedgeId h) {
      return subject_.mesh.origin()[static_cast<std::size_t>(h.value)];
    };
    for (const SurfacePoint& point : order.points) {
      const auto& at = point.corners;
      questions.push_back({{vertex(at[0]), vertex(at[1]), vertex(at[2])},
                           point.weights,
                           vertex(at[ray::nearest_corner(point)])});
    }
    return questions;
  }

  /// What has to be paid before the first hit, apart from what a hit costs.
  void add_conversion(const char* who, double ms) {
    rows_.add({"S0", "from faces to connectivity", who,
               static_cast<double>(subject_.faces()) / ms / 1e3, "Mfaces/s",
               "once, on one thread"});
  }

  Rows& rows_;
  const Subject& subject_;
  const FrameOptions& options_;
  Buffer<float> normals_;
  ray::NearbySearch search_;
  std::optional<ray::Scene> scene_;
  std::vector<HitOrder> orders_;
  std::vector<HitSum> expected_;
  volatile double sink_ = 0;  // or the compiler would leave out what nobody compares
};

}  // namespace

void measure_hits(Rows& rows, const Subject& subject, const FrameOptions& options) {
  HitStages(rows, subject, options).measure();
}

}  // namespace hedgerow::bench
