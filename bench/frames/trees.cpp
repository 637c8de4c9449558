#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <tbb/info.h>
#include <tbb/task_arena.h>

#include "frames/rays.h"
#include "frames/stages.h"

namespace hedgerow::bench {
namespace {

using ray::Motion;
using ray::PaddedPositions;
using ray::Scene;

class TreeStages {
 public:
  TreeStages(Rows& rows, const Subject& subject, const FrameOptions& options)
      : rows_(rows),
        subject_(subject),
        options_(options),
        xyz_(Buffer<float>::copy_of(subject.soup.xyz.span())),
        packets_(primary_rays(subject, options.still_rays / 4)),
        hits_(packets_.size()),
        arena_(tbb::info::default_concurrency()),
        execution_(Execution::in(arena_)) {}

  void measure() {
    device_.emplace(std::move(*ray::Device::create()));
    measure_build("build, still", {});
    measure_build("build, moving", {.motion = Motion::moving});
    measure_build("build, moving in pieces", pieces());
    measure_refits("whole", {.motion = Motion::moving});
    measure_refits("pieces", pieces());
    measure_decay("rotation", rotate);
    measure_decay("twist", twist);
  }

 private:
  [[nodiscard]] ray::SceneOptions pieces() const {
    return {.motion = Motion::moving, .piece_faces = options_.piece_faces};
  }
  [[nodiscard]] Result<Scene> build(const ray::SceneOptions& options) const {
    return Scene::build(*device_, subject_.mesh, PaddedPositions::of(xyz_), options, execution_);
  }
  void add(const std::string& what, const std::string& variant, double value, const char* unit,
           std::string note = {}) {
    rows_.add({"S3", what, variant, value, unit, std::move(note)});
  }
  void measure_build(const char* what, const ray::SceneOptions& options) {
    const double ms = best_ms(options_.runs, [&] {
      if (!build(options)) rows_.fail(what);
    });
    add(what, fmt::format("{} threads", execution_.threads()), ms, "ms");
  }

  void measure_refits(const char* variant, const ray::SceneOptions& options) {
    auto scene = build(options);
    if (!scene) return rows_.fail(variant);
    add("copied to attach", variant, static_cast<double>(scene->stats().copied_bytes), "bytes");
    bool has_built = false;
    double ms = best_ms(options_.runs, [&] {
      (void)scene->refit(execution_);
      has_built = has_built || scene->has_built();
    });
    add("refit, everything moved", variant, ms, "ms");
    DirtySet dirty(subject_.mesh);
    (void)dirty.find(subject_.mesh, MovedVertices::list(subject_.blob));
    ms = best_ms(options_.runs, [&] {
      (void)scene->refit(dirty, execution_);
      has_built = has_built || scene->has_built();
    });
    add("refit, 1% moved", variant, ms, "ms",
        fmt::format("{} of {} pieces", scene->refitted_pieces(), scene->stats().piece_count));
    if (has_built) rows_.fail("S3: a refit built a tree");
    ms = best_ms(options_.runs, [&] { (void)scene->rebuild(execution_); });
    add("rebuild", variant, ms, "ms");
  }

  double trace_ms(const Scene& scene) {
    return best_ms(options_.runs, [&] {
      for (std::size_t i = 0; i < packets_.size(); ++i) hits_[i] = scene.intersect(packets_[i]);
    });
  }

  /// How rays slow down on a tree that is refitted again and again, against one built anew.
  void measure_decay(const char* motion, void (*move)(const Subject&, float, Buffer<float>&)) {
    std::ranges::copy(subject_.soup.xyz, xyz_.begin());
    auto scene = build({.motion = Motion::moving});
    if (!scene) return rows_.fail(motion);
    double rebuild_ms = 0;
    for (int frame = 1; frame <= 100; ++frame) {
      move(subject_, 0.03F * static_cast<float>(frame), xyz_);
      (void)scene->refit(execution_);
      if (scene->has_built()) rows_.fail("S3: a refit built a tree");
      if (frame != 1 && frame != 10 && frame != 100) continue;
      const double ms = trace_ms(*scene);
      const std::int64_t wrong =
          wrong_hits(subject_, xyz_, packets_, hits_, affordable_sample(subject_) / 10);
      if (wrong > 0) rows_.fail(fmt::format("S3: {} wrong after {} refits", wrong, frame));
      auto fresh = build({.motion = Motion::moving});
      if (!fresh) return rows_.fail(motion);
      const double fresh_ms = trace_ms(*fresh);
      if (rebuild_ms == 0) rebuild_ms = best_ms(2, [&] { (void)fresh->rebuild(execution_); });
      const auto count = static_cast<double>(count_rays(packets_));
      const double lost_ns = (ms - fresh_ms) * 1e6 / count;
      add(fmt::format("rays after {} refits", frame), motion, count / ms / 1e3, "Mrays/s",
          fmt::format("{:.2f} times the time of a tree built anew; {}", ms / fresh_ms,
                      lost_ns > 0.5 ? fmt::format("a rebuild pays from {:.1f} million rays on",
                                                  rebuild_ms / lost_ns)
                                    : "a rebuild never pays"));
    }
    std::ranges::copy(subject_.soup.xyz, xyz_.begin());
  }

  Rows& rows_;
  const Subject& subject_;
  const FrameOptions& options_;
  Buffer<float> xyz_;
  Packets packets_;
  std::vector<ray::HitPacket> hits_;
  tbb::task_arena arena_;
  Execution execution_;
  std::optional<ray::Device> device_;
};

}  // namespace

void measure_trees(Rows& rows, const Subject& subject, const FrameOptions& options) {
  TreeStages(rows, subject, options).measure();
}

}  // namespace hedgerow::bench
