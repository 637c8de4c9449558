// The frame of a renderer: deform, normals, refit, rays, connectivity at the hits; one frame after
// the other, or with two sets of buffers, one of which is traced while the other is updated.
#include <algorithm>
#include <array>
#include <cstring>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>
#include <tbb/task_arena.h>

#include "frames/rays.h"
#include "frames/stages.h"
#include "hedgerow/circulate.h"
#include "hedgerow/dirty_normals.h"
#include "hedgerow/ray/surface.h"
#include "memory_use.h"
#include "peers/measured_mesh.h"

namespace hedgerow::bench {
namespace {

constexpr std::int64_t kWarmUp = 2;
// Embree allocates two objects more at the first commit of each thread, and TBB may hand a thread
// its first one in any frame.
constexpr std::int64_t kFirstCommits = 8;

enum Part : std::size_t { kDeform, kNormals, kRefit, kRays, kHits, kParts };
constexpr std::array<const char*, kParts> kPartNames = {"deform", "normals", "refit", "rays",
                                                        "hits"};
using PartTimes = std::array<double, kParts>;

/// Adds the time since it was made, or since the last call, to a part.
class Lap {
 public:
  explicit Lap(PartTimes& times) : times_(times) {}
  void end(Part part) {
    const double now = now_ms();
    times_[part] += now - last_;
    last_ = now;
  }

 private:
  PartTimes& times_;
  double last_ = now_ms();
};

/// Everything that one frame writes. The connectivity is shared.
class FrameBuffers {
 public:
  FrameBuffers(const Subject& subject, const ray::Device& device, const FrameOptions& options)
      : subject_(subject),
        xyz_(Buffer<float>::copy_of(subject.soup.xyz.span())),
        normals_(xyz_.size()),
        dirty_(subject.mesh),
        packets_(primary_rays(subject, options.rays)),
        hits_(packets_.size()),
        answers_(packets_.size()),
        scene_(
            *ray::Scene::build(device, subject.mesh, ray::PaddedPositions::of(xyz_),
                               {.motion = ray::Motion::moving, .piece_faces = options.piece_faces},
                               Execution::serial())) {
    (void)gather_vertex_normals(subject.mesh, positions(), normals_out(), {}, Execution::serial(),
                                workspace_);
  }

  /// `is_all`: every vertex moves; else those of the blob.
  void update(float time, bool is_all, const Execution& execution, PartTimes& times) {
    Lap lap(times);
    deform(subject_, is_all ? std::span<const Index>() : std::span<const Index>(subject_.blob),
           time, xyz_);
    lap.end(kDeform);
    const MovedVertices moved = is_all ? MovedVertices::range({0, subject_.mesh.vertex_count()})
                                       : MovedVertices::list(subject_.blob);
    is_good_ = dirty_.find(subject_.mesh, moved) &&
               update_vertex_normals(subject_.mesh, positions(), normals_out(), {}, dirty_,
                                     execution, workspace_) &&
               is_good_;
    lap.end(kNormals);
    is_good_ = scene_.refit(dirty_, execution) && !scene_.has_built() && is_good_;
    lap.end(kRefit);
  }

  /// `run(count, body)` calls body(begin, end) for parts of [0, count).
  template <class Run>
  void trace(const Run& run, PartTimes& times) {
    Lap lap(times);
    run(packets_.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) hits_[i] = scene_.intersect(packets_[i]);
    });
    lap.end(kRays);
    subject_.mesh.visit([&](const auto& view) {
      run(packets_.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) answers_[i] = ask(view, hits_[i]);
      });
    });
    lap.end(kHits);
  }

  /// Empty if every answer of the last frame is right, else what is not.
  [[nodiscard]] std::string check(std::int64_t sample) const {
    if (!is_good_) return "an operation failed, or a refit built a tree";
    Buffer<float> expected(normals_.size());
    Workspace workspace;
    (void)gather_vertex_normals(subject_.mesh, positions(), {expected.data(), subject_.vertices()},
                                {}, Execution::serial(), workspace);
    if (std::memcmp(expected.data(), normals_.data(), normals_.size_bytes()) != 0) {
      return "the normals differ from those of a full pass";
    }
    const std::int64_t wrong = wrong_hits(subject_, xyz_, packets_, hits_, sample);
    return wrong == 0 ? std::string() : fmt::format("{} of {} rays are wrong", wrong, sample);
  }
  [[nodiscard]] std::string rates() const {
    return fmt::format("{} rays, {} hits, {} dirty vertices, {} of {} pieces", count_rays(packets_),
                       count_hits(hits_),
                       dirty_.is_all() ? subject_.vertices() : std::ssize(dirty_.vertices()),
                       scene_.refitted_pieces(), scene_.stats().piece_count);
  }
  [[nodiscard]] ray::Scene& scene() noexcept { return scene_; }
  [[nodiscard]] Positions positions() const noexcept { return {xyz_.data(), subject_.vertices()}; }
  [[nodiscard]] Buffer<float>& xyz() noexcept { return xyz_; }

 private:
  [[nodiscard]] NormalsOut normals_out() noexcept { return {normals_.data(), subject_.vertices()}; }

  template <Topology Mesh>
  float ask(const Mesh& mesh, const ray::HitPacket& packet) const {
    float sum = 0;
    for (const ray::Hit& hit : packet) {
      if (!hit.valid()) continue;
      const ray::SurfacePoint point = scene_.primitives().point(hit);
      const ray::Vec3 normal =
          ray::interpolate_normal(mesh, point, {normals_.data(), subject_.vertices()});
      std::uint32_t ring = 0;
      for (const VertexId u : neighbours(mesh, ray::nearest_vertex(mesh, point))) {
        ring += static_cast<std::uint32_t>(u.value);
      }
      sum += normal[2] + static_cast<float>(ring & 1U);
    }
    return sum;
  }

  const Subject& subject_;
  Buffer<float> xyz_;
  Buffer<float> normals_;
  DirtySet dirty_;
  Workspace workspace_;
  Packets packets_;
  std::vector<ray::HitPacket> hits_;
  std::vector<float> answers_;
  ray::Scene scene_;
  bool is_good_ = true;
};

class FrameStages {
 public:
  FrameStages(Rows& rows, const Subject& subject, const FrameOptions& options)
      : rows_(rows),
        subject_(subject),
        options_(options),
        device_(std::move(*ray::Device::create())) {}

  void measure() {
    std::vector<int> counts = {1};
    if (tbb::info::default_concurrency() > 1) counts.push_back(tbb::info::default_concurrency());
    for (const bool is_all : {false, true}) {
      for (const int count : counts) run_in_turn(is_all, count);
      run_pipelined(is_all);
    }
    for (const Peer& peer : peers()) {
      if (peer.has_normals && !peer.is_baseline) measure_peer(peer);
    }
  }

 private:
  static float time_of(std::int64_t frame) { return 0.05F * static_cast<float>(frame); }

  void run_in_turn(bool is_all, int threads) {
    FrameBuffers buffers(subject_, device_, options_);
    tbb::task_arena arena(threads);
    const Execution execution = threads == 1 ? Execution::serial() : Execution::in(arena);
    const auto run = [&](std::size_t count, const auto& body) {
      if (threads == 1) return body(std::size_t{0}, count);
      arena.execute([&] {
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 64),
                          [&](const auto& r) { body(r.begin(), r.end()); });
      });
    };
    const auto frame = [&](std::int64_t number, PartTimes& parts) {
      buffers.update(time_of(number), is_all, execution, parts);
      buffers.trace(run, parts);
    };
    measure_loop(fmt::format("{}, in turn, {} thread{}", moved_text(is_all), threads,
                             threads == 1 ? "" : "s"),
                 frame, 1);
    finish(buffers, is_all);
  }

  /// While the buffers of one frame are traced, the others are updated for the next.
  void run_pipelined(bool is_all) {
    std::array<FrameBuffers, 2> buffers = {FrameBuffers(subject_, device_, options_),
                                           FrameBuffers(subject_, device_, options_)};
    PartTimes ignored{};
    buffers[0].update(time_of(0), is_all, Execution::serial(), ignored);
    const auto run = [](std::size_t count, const auto& body) { body(std::size_t{0}, count); };
    tbb::task_arena arena(2);
    const auto frame = [&](std::int64_t number, PartTimes& parts) {
      FrameBuffers& shown = buffers[static_cast<std::size_t>(number % 2)];
      FrameBuffers& next = buffers[static_cast<std::size_t>((number + 1) % 2)];
      PartTimes update_parts{};
      arena.execute([&] {
        tbb::parallel_invoke(
            [&] { next.update(time_of(number + 1), is_all, Execution::serial(), update_parts); },
            [&] { shown.trace(run, parts); });
      });
      for (std::size_t i = 0; i < kParts; ++i) parts[i] += update_parts[i];
    };
    measure_loop(fmt::format("{}, double-buffered, 2 threads", moved_text(is_all)), frame, 1);
    // The buffers that were traced last.
    finish(buffers[static_cast<std::size_t>((options_.frames + 1) % 2)], is_all);
  }

  static const char* moved_text(bool is_all) { return is_all ? "100% moved" : "1% moved"; }

  template <class Frame>
  void measure_loop(const std::string& what, const Frame& frame, int commits) {
    std::vector<double> times(static_cast<std::size_t>(options_.frames));
    PartTimes parts{};
    for (std::int64_t number = 0; number < kWarmUp; ++number) frame(number, parts);
    parts = {};
    const MemoryUse memory = memory_use_of([&] {
      for (std::int64_t i = 0; i < options_.frames; ++i) {
        const double start = now_ms();
        frame(kWarmUp + i, parts);
        times[static_cast<std::size_t>(i)] = now_ms() - start;
      }
    });
    for (const auto& [share, name] : {std::pair{0.5, "p50"}, std::pair{0.99, "p99"},
                                      std::pair{0.999, "p99.9"}, std::pair{1.0, "max"}}) {
      rows_.add({"S6", what, name, percentile(times, share), "ms",
                 fmt::format("{} frames", options_.frames)});
    }
    const double whole = std::accumulate(parts.begin(), parts.end(), 0.0);
    for (std::size_t i = 0; i < kParts; ++i) {
      rows_.add({"S6", what, kPartNames[i], parts[i] / static_cast<double>(options_.frames), "ms",
                 fmt::format("{:.1f} % of the work", 100 * parts[i] / whole)});
    }
    const double per_frame =
        static_cast<double>(memory.allocations) / static_cast<double>(options_.frames);
    rows_.add({"S6", what, "allocations", per_frame, "a frame",
               fmt::format("{} of them Embree's name for each commit", commits)});
    if (memory.allocations > options_.frames * commits + kFirstCommits) {
      rows_.fail("S6: a frame allocates: " + what);
    }
  }

  void finish(FrameBuffers& buffers, bool is_all) {
    const std::string wrong = buffers.check(affordable_sample(subject_) / 10 + 1);
    if (!wrong.empty()) rows_.fail(fmt::format("S6, {}: {}", moved_text(is_all), wrong));
    rows_.add({"S6", moved_text(is_all), "checked", wrong.empty() ? 1.0 : 0.0, "yes = 1",
               buffers.rates()});
  }

  /// What a frame costs with another mesh library: its normals, and a tree built anew.
  void measure_peer(const Peer& peer) {
    FrameBuffers buffers(subject_, device_, options_);
    const auto mesh = peer.build(subject_.soup.face_list(), subject_.soup.positions());
    if (mesh == nullptr) return;
    tbb::task_arena arena(tbb::info::default_concurrency());
    deform(subject_, {}, 1, buffers.xyz());
    const double moving = best_ms(options_.runs, [&] { mesh->move_to(buffers.positions()); });
    const double normals = best_ms(options_.runs, [&] { mesh->compute_vertex_normals(); });
    const double tree =
        best_ms(options_.runs, [&] { (void)buffers.scene().rebuild(Execution::in(arena)); });
    rows_.add({"S6", "100% moved, positions handed over", peer.name, moving, "ms", "one thread"});
    rows_.add({"S6", "100% moved, normals", peer.name, normals, "ms", "one thread"});
    rows_.add({"S6", "100% moved, tree built anew", peer.name, tree, "ms",
               fmt::format("{} threads", arena.max_concurrency())});
  }

  Rows& rows_;
  const Subject& subject_;
  const FrameOptions& options_;
  ray::Device device_;
};

}  // namespace

void measure_frames(Rows& rows, const Subject& subject, const FrameOptions& options) {
  FrameStages(rows, subject, options).measure();
}

}  // namespace hedgerow::bench
