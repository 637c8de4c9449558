// What a shader asks the mesh at a hit. One thread: threads scale by cutting up the hits.
#include <algorithm>
#include <array>
#include <functional>
#include <memory>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "baselines/pointer_mesh.h"
#include "frames/edge_hash.h"
#include "frames/rays.h"
#include "frames/stages.h"
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

constexpr std::size_t kBatch = 256;  // hits between two looks at the clock
constexpr int kWalkSteps = 50;

/// What the answers add up to: compared between ways to the same answers.
struct Sum {
  std::uint32_t ring = 0;
  double normal = 0;
};

struct HitOrder {
  const char* name;
  std::vector<SurfacePoint> points;
};

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
    if (subject_.soup.offsets.empty()) measure_hash();
    measure_pointers();
    measure_peers();
  }

 private:
  [[nodiscard]] Positions normals() const { return {normals_.data(), subject_.vertices()}; }

  void make_orders() {
    const auto device = ray::Device::create();
    const auto scene =
        ray::Scene::build(*device, subject_.mesh, ray::PaddedPositions::of(subject_.soup.xyz), {},
                          Execution::serial());
    const auto trace = [&](const Packets& packets) {
      std::vector<ray::HitPacket> hits(packets.size());
      for (std::size_t i = 0; i < packets.size(); ++i) hits[i] = scene->intersect(packets[i]);
      return hits;
    };
    const auto points_of = [&](const std::vector<ray::HitPacket>& hits) {
      std::vector<SurfacePoint> points;
      for (const ray::HitPacket& packet : hits) {
        for (const ray::Hit& hit : packet) {
          if (hit.valid()) points.push_back(scene->primitives().point(hit));
        }
      }
      return points;
    };
    const Packets primary = primary_rays(subject_, options_.still_rays);
    const auto hits = trace(primary);
    orders_.push_back({"coherent", points_of(hits)});
    orders_.push_back(
        {"bounce", points_of(trace(scattered_rays(subject_, *scene, primary, hits, 1, 10)))});
    std::vector<SurfacePoint> shuffled = orders_.front().points;
    std::mt19937_64 random(5);
    for (std::size_t i = shuffled.size(); i > 1; --i)
      std::swap(shuffled[i - 1], shuffled[random() % i]);
    orders_.push_back({"shuffled", std::move(shuffled)});
    std::erase_if(orders_, [](const HitOrder& order) { return order.points.empty(); });
    if (orders_.empty()) rows_.fail("S5: no ray met anything");
  }

  /// Measures `ask(point, sum)` over all points, or over the first `limit`.
  template <class Ask>
  Sum measure_ask(const char* what, const std::string& variant, const HitOrder& order,
                  std::size_t limit, const Ask& ask) {
    const std::span<const SurfacePoint> points(order.points.data(),
                                               std::min(limit, order.points.size()));
    Sum sum;
    std::vector<double> batches;
    double best = 1e300;
    for (int run = 0; run <= options_.runs; ++run) {
      sum = {};
      batches.clear();
      const double start = now_ms();
      double last = start;
      for (std::size_t begin = 0; begin < points.size(); begin += kBatch) {
        const std::size_t end = std::min(begin + kBatch, points.size());
        for (std::size_t i = begin; i < end; ++i) ask(points[i], sum);
        const double now = now_ms();
        batches.push_back((now - last) * 1e6 / static_cast<double>(end - begin));
        last = now;
      }
      if (run > 0) best = std::min(best, last - start);
    }
    sink_ = sink_ + static_cast<double>(sum.ring) + sum.normal;
    rows_.add({"S5", fmt::format("{}, {}", what, order.name), variant,
               best * 1e6 / static_cast<double>(points.size()), "ns/hit",
               fmt::format("{} hits, p99 of batches {:.0f} ns", points.size(),
                           percentile(batches, 0.99))});
    return sum;
  }

  template <Topology Mesh>
  void measure_ours(const Mesh& mesh, const HitOrder& order) {
    const auto add_normal = [&](const SurfacePoint& point, Sum& sum) {
      const Vec3 normal = ray::interpolate_normal(mesh, point, normals());
      sum.normal += static_cast<double>(normal[0] + normal[1] + normal[2]);
    };
    const auto add_ring = [&](const SurfacePoint& point, Sum& sum) {
      for (const VertexId u : neighbours(mesh, ray::nearest_vertex(mesh, point))) {
        sum.ring += static_cast<std::uint32_t>(u.value);
      }
    };
    constexpr std::size_t kAll = ~std::size_t{0};
    constexpr std::size_t kSome = 50'000;
    (void)measure_ask("normal", "hedgerow", order, kAll, add_normal);
    expected_.push_back(measure_ask("one-ring", "hedgerow", order, kAll, add_ring));
    (void)measure_ask("normal and one-ring", "hedgerow", order, kAll,
                      [&](const SurfacePoint& point, Sum& sum) {
                        add_normal(point, sum);
                        add_ring(point, sum);
                      });
    const float radius = 0.01F * subject_.diagonal;
    (void)measure_ask("two-ring", "hedgerow", order, kSome,
                      [&](const SurfacePoint& point, Sum& sum) {
                        sum.ring += static_cast<std::uint32_t>(
                            search_.k_ring(mesh, ray::nearest_vertex(mesh, point), 2).size());
                      });
    (void)measure_ask(
        "ball of 1% of the diagonal", "hedgerow", order, kSome / 50,
        [&](const SurfacePoint& point, Sum& sum) {
          sum.ring += static_cast<std::uint32_t>(
              search_.geodesic_ball(mesh, subject_.soup.positions(), point, radius).size());
        });
    (void)measure_ask(
        "walk of 50 edges", "hedgerow", order, kSome / 10,
        [&](const SurfacePoint& point, Sum& sum) {
          std::array<VertexId, kWalkSteps> steps;
          sum.ring += static_cast<std::uint32_t>(ray::edge_walk(
              mesh, subject_.soup.positions(), ray::nearest_vertex(mesh, point), {1, 0, 0}, steps));
        });
    (void)measure_ask("on the boundary", "hedgerow", order, kAll,
                      [&](const SurfacePoint& point, Sum& sum) {
                        sum.ring += is_boundary(mesh, ray::nearest_vertex(mesh, point)) ? 1 : 0;
                      });
  }

  /// Embree's user with index arrays alone: normals, but no neighbours.
  void measure_raw(const HitOrder& order) {
    const Index* corners = subject_.soup.corners.data();
    (void)measure_ask("normal", "raw index arrays", order, ~std::size_t{0},
                      [&](const SurfacePoint& point, Sum& sum) {
                        Vec3 normal{};
                        for (std::size_t k = 0; k < 3; ++k) {
                          const float* at = normals()[corners[point.corners[k].value]];
                          for (std::size_t axis = 0; axis < 3; ++axis) {
                            normal[axis] += point.weights[k] * at[axis];
                          }
                        }
                        const float scale = 1 / ray::detail::length(normal);
                        sum.normal +=
                            static_cast<double>((normal[0] + normal[1] + normal[2]) * scale);
                      });
  }

  void compare(const char* who, std::size_t order, std::uint32_t ring) {
    // A vertex with several fans shows one of them to the others.
    if (ring == expected_[order].ring || !subject_.mesh.fans().empty()) return;
    rows_.fail(fmt::format("S5 one-ring, {}: {}", orders_[order].name, who));
  }

  void measure_hash() {
    const double start = now_ms();
    const EdgeHash hash(subject_.soup);
    rows_.add({"S0", "conversion, order of the file", "edge hash map",
               static_cast<double>(subject_.faces()) / (now_ms() - start) / 1e3, "Mfaces/s",
               "one thread"});
    for (std::size_t i = 0; i < orders_.size(); ++i) {
      const Sum sum =
          measure_ask("normal and one-ring", "edge hash map", orders_[i], 200'000,
                      [&](const SurfacePoint& point, Sum& out) {
                        const Vec3 normal =
                            ray::interpolate_normal(subject_.mesh.triangles(), point, normals());
                        out.normal += static_cast<double>(normal[0] + normal[1] + normal[2]);
                        out.ring += hash.ring_sum(point.corners[ray::nearest_corner(point)].value);
                      });
      Sum ours;
      const TriangleView view = subject_.mesh.triangles();
      const std::size_t count = std::min<std::size_t>(200'000, orders_[i].points.size());
      for (std::size_t k = 0; k < count; ++k) {
        for (const VertexId u : neighbours(view, ray::nearest_vertex(view, orders_[i].points[k]))) {
          ours.ring += static_cast<std::uint32_t>(u.value);
        }
      }
      if (sum.ring != ours.ring && subject_.mesh.fans().empty()) {
        rows_.fail(fmt::format("S5 one-ring, {}: edge hash map", orders_[i].name));
      }
    }
  }

  void measure_pointers() {
    baselines::PointerHalfedgeMesh pointer(subject_.soup.face_list(), subject_.soup.positions());
    for (Index v = 0; v < subject_.mesh.vertex_count(); ++v) {
      std::copy_n(normals()[v], 3, pointer.vertex(v).normal);
    }
    for (std::size_t i = 0; i < orders_.size(); ++i) {
      const Sum sum = measure_ask(
          "normal and one-ring", "pointer half-edge", orders_[i], ~std::size_t{0},
          [&](const SurfacePoint& point, Sum& out) {
            Vec3 normal{};
            for (std::size_t k = 0; k < 3; ++k) {
              const float* at = pointer.halfedge(point.corners[k].value).vertex->normal;
              for (std::size_t axis = 0; axis < 3; ++axis) {
                normal[axis] += point.weights[k] * at[axis];
              }
            }
            const float scale = 1 / ray::detail::length(normal);
            out.normal += static_cast<double>((normal[0] + normal[1] + normal[2]) * scale);
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
          });
      compare("pointer half-edge", i, sum.ring);
    }
  }

  void measure_peers() {
    for (const Peer& peer : peers()) {
      if (peer.is_baseline) continue;
      const auto mesh = peer.build(subject_.soup.face_list(), subject_.soup.positions());
      if (mesh == nullptr) continue;
      for (std::size_t i = 0; i < orders_.size(); ++i) {
        std::vector<Index> vertices;
        for (const SurfacePoint& point : orders_[i].points) {
          const auto h = static_cast<std::size_t>(point.corners[ray::nearest_corner(point)].value);
          vertices.push_back(subject_.mesh.origin()[h]);
        }
        std::vector<std::uint32_t> sums(vertices.size());
        const double ms =
            best_ms(options_.runs, [&] { mesh->fill_one_ring_sums_at(vertices, sums); });
        rows_.add({"S5", fmt::format("one-ring, {}", orders_[i].name), peer.name,
                   ms * 1e6 / static_cast<double>(vertices.size()), "ns/hit",
                   fmt::format("{} hits", vertices.size())});
        compare(peer.name, i, std::accumulate(sums.begin(), sums.end(), std::uint32_t{0}));
      }
    }
  }

  Rows& rows_;
  const Subject& subject_;
  const FrameOptions& options_;
  Buffer<float> normals_;
  ray::NearbySearch search_;
  std::vector<HitOrder> orders_;
  std::vector<Sum> expected_;
  volatile double sink_ = 0;  // or the compiler would leave out what nobody compares
};

}  // namespace

void measure_hits(Rows& rows, const Subject& subject, const FrameOptions& options) {
  HitStages(rows, subject, options).measure();
}

}  // namespace hedgerow::bench
