// The frame of a renderer: deform, normals, refit, rays, connectivity at the hits; one frame after
// the other, or with two sets of buffers, one of which is traced while the other is updated.
#include <algorithm>
#include <array>
#include <numeric>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <tbb/info.h>
#include <tbb/parallel_invoke.h>
#include <tbb/task_arena.h>

#include "frames/frame.h"
#include "frames/stages.h"
#include "memory_use.h"
#include "peers/measured_mesh.h"

namespace hedgerow::bench {
namespace {

constexpr std::int64_t kWarmUp = 2;
// Embree allocates two objects more at the first commit of each thread, and TBB may hand a thread
// its first one in any frame.
constexpr std::int64_t kFirstCommits = 8;
constexpr std::array<const char*, kFrameParts> kPartNames = {"deform", "normals", "refit", "rays",
                                                             "hits"};

float time_of(std::int64_t frame) { return 0.05F * static_cast<float>(frame); }

const char* text_of(Change change) {
  if (change == Change::all) return "100% moved";
  return change == Change::some ? "1% moved" : "1% moved, all updated";
}

class FrameStages {
 public:
  FrameStages(Rows& rows, const Subject& subject, const FrameOptions& options)
      : rows_(rows),
        subject_(subject),
        options_(options),
        device_(std::move(*ray::Device::create())) {}

  void measure() {
    const int all_threads = tbb::info::default_concurrency();
    if (options_.moves_some) {
      measure_change(Change::some);
      if (wants("parallel")) {
        run_in_turn(Change::some_whole, all_threads,
                    std::max<std::int64_t>(options_.frames / 50, 1));
      }
    }
    if (options_.moves_all) {
      measure_change(Change::all);
      for (const Peer& peer : peers()) {
        if (peer.has_normals && !peer.is_baseline) measure_peer(peer);
      }
    }
  }

 private:
  void measure_change(Change change) {
    const int all_threads = tbb::info::default_concurrency();
    if (wants("serial")) run_in_turn(change, 1, options_.frames);
    if (wants("parallel") && all_threads > 1) run_in_turn(change, all_threads, options_.frames);
    if (wants("double")) run_pipelined(change);
  }
  [[nodiscard]] bool wants(const char* loop) const {
    return options_.loops.find(loop) != std::string::npos;
  }

  void run_in_turn(Change change, int thread_count, std::int64_t frames) {
    Frame frame(subject_, device_, options_);
    tbb::task_arena arena(thread_count);
    const FrameThreads threads{thread_count == 1 ? nullptr : &arena};
    const auto draw = [&](std::int64_t number, PartTimes& parts) {
      frame.update(time_of(number), change, threads, parts);
      frame.trace(threads, parts);
    };
    measure_loop(fmt::format("{}, in turn, {} thread{}", text_of(change), thread_count,
                             thread_count == 1 ? "" : "s"),
                 frames, {&frame, 1}, draw);
    finish(frame, change);
  }

  /// While the buffers of one frame are traced, the others are updated for the next.
  void run_pipelined(Change change) {
    std::array<Frame, 2> frames = {Frame(subject_, device_, options_),
                                   Frame(subject_, device_, options_)};
    PartTimes ignored{};
    frames[0].update(time_of(0), change, {}, ignored);
    tbb::task_arena arena(2);
    const auto draw = [&](std::int64_t number, PartTimes& parts) {
      Frame& shown = frames[static_cast<std::size_t>(number % 2)];
      Frame& next = frames[static_cast<std::size_t>((number + 1) % 2)];
      PartTimes update_parts{};
      arena.execute([&] {
        tbb::parallel_invoke([&] { next.update(time_of(number + 1), change, {}, update_parts); },
                             [&] { shown.trace({}, parts); });
      });
      for (std::size_t i = 0; i < kFrameParts; ++i) parts[i] += update_parts[i];
    };
    measure_loop(fmt::format("{}, double-buffered, 2 threads", text_of(change)), options_.frames,
                 frames, draw);
    // The buffers that were traced last.
    finish(frames[static_cast<std::size_t>((options_.frames + 1) % 2)], change);
  }

  template <class Draw>
  void measure_loop(const std::string& what, std::int64_t count, std::span<Frame> frames,
                    const Draw& draw) {
    std::vector<double> times(static_cast<std::size_t>(count));
    PartTimes parts{};
    for (std::int64_t number = 0; number < kWarmUp; ++number) draw(number, parts);
    parts = {};
    std::int64_t in_refits = 0;
    const MemoryUse memory = memory_use_of([&] {
      in_refits = -refit_allocations(frames);
      for (std::int64_t i = 0; i < count; ++i) {
        const double start = now_ms();
        draw(kWarmUp + i, parts);
        times[static_cast<std::size_t>(i)] = now_ms() - start;
      }
    });
    in_refits += refit_allocations(frames);
    for (const auto& [share, name] :
         {std::pair{0.5, "p50"}, std::pair{0.95, "p95"}, std::pair{0.99, "p99"},
          std::pair{0.999, "p99.9"}, std::pair{1.0, "max"}}) {
      rows_.add(
          {"S6", what, name, percentile(times, share), "ms", fmt::format("{} frames", count)});
    }
    const double whole = std::accumulate(parts.begin(), parts.end(), 0.0);
    for (std::size_t i = 0; i < kFrameParts; ++i) {
      rows_.add({"S6", what, kPartNames[i], parts[i] / static_cast<double>(count), "ms",
                 fmt::format("{:.1f} % of the work", 100 * parts[i] / whole)});
    }
    add_allocations(what, count, memory.allocations, in_refits);
  }

  static std::int64_t refit_allocations(std::span<const Frame> frames) {
    std::int64_t sum = 0;
    for (const Frame& frame : frames) sum += frame.refit_allocations();
    return sum;
  }

  /// Each commit asks for a string, in Embree, before it looks at anything: see `Scene`. Nothing
  /// else may be asked for.
  void add_allocations(const std::string& what, std::int64_t count, std::int64_t allocations,
                       std::int64_t in_refits) {
    const std::int64_t others = allocations - in_refits;
    rows_.add({"S6", what, "allocations", static_cast<double>(others) / static_cast<double>(count),
               "a frame", fmt::format("and {} by Embree, for {} commits", in_refits, count)});
    if (others != 0 || in_refits > count + kFirstCommits) {
      rows_.fail(fmt::format("S6: {} allocations and {} in refits, {} frames: {}", others,
                             in_refits, count, what));
    }
  }

  void finish(const Frame& frame, Change change) {
    const std::string wrong = frame.check(affordable_sample(subject_) / 10 + 1);
    if (!wrong.empty()) rows_.fail(fmt::format("S6, {}: {}", text_of(change), wrong));
    rows_.add(
        {"S6", text_of(change), "checked", wrong.empty() ? 1.0 : 0.0, "yes = 1", frame.rates()});
  }

  /// What a frame costs with another mesh library: its normals, and a tree built anew.
  void measure_peer(const Peer& peer) {
    Frame frame(subject_, device_, options_);
    const auto mesh = peer.build(subject_.soup.face_list(), subject_.soup.positions());
    if (mesh == nullptr) return;
    tbb::task_arena arena(tbb::info::default_concurrency());
    PartTimes ignored{};
    frame.update(1, Change::all, {&arena}, ignored);
    const double moving = best_ms(options_.runs, [&] { mesh->move_to(frame.positions()); });
    const double normals = best_ms(options_.runs, [&] { mesh->compute_vertex_normals(); });
    const double tree =
        best_ms(options_.runs, [&] { (void)frame.scene().rebuild(Execution::in(arena)); });
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
