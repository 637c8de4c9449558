#include "plan.h"

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <thread>
#include <unistd.h>

#include "baselines/bandwidth.h"
#include "mesh_source.h"

namespace hedgerow::bench {

namespace {

/// Connectivity, positions and one normal a vertex.
constexpr std::int64_t kTriangleBytes = 26 + 6 + 6;
/// The mesh, the reference and their scratch memory while the reference is made.
constexpr std::int64_t kPeakTriangleBytes = 300;
/// Checking a shuffled mesh against the reference takes a second and a half for each million.
constexpr std::int64_t kPatience = 16'000'000;
constexpr std::int64_t kMillion = 1'000'000;
/// Below 20 scans a face the window is chosen; see PERF.md, "Strategy of the builder".
constexpr int kMovedPerMille[] = {0, 1, 2, 5, 10, 20, 40, 80, 160, 400};

void add_orders(Plan& plan, std::int64_t size, bool with_peers) {
  for (const char* order : {"grid", "scan", "shuffled"}) {
    const DatasetKey key{order, size, ""};
    plan.all.push_back(key);
    if (with_peers) plan.with_peers.push_back(key);
  }
}

Plan smoke_plan() {
  Plan plan;
  add_orders(plan, 200, true);
  plan.large = plan.all;
  plan.all.push_back({"reordered", 200, ""});
  plan.all.push_back({"icosphere", 320, ""});
  plan.all.push_back({"fan", 300, ""});
  plan.disordered = {{"moved-0", 200, ""}, {"moved-400", 200, ""}};
  plan.planar = {{"points", 200, ""}};
  plan.imr = {{"grid", 200, ""}, {"scan", 200, ""}, {"icosphere", 320, ""}};
  plan.represented = {{"grid", 200, ""}, {"shuffled", 200, ""}, {"icosphere", 320, ""}};
  return plan;
}

Plan represented_plan() {
  Plan plan;
  for (const std::int64_t size : {std::int64_t{10'000}, kMillion, 4 * kMillion}) {
    for (const char* order : {"grid", "shuffled"}) plan.represented.push_back({order, size, ""});
  }
  return plan;
}

Plan imr_plan() {
  Plan plan;
  plan.imr = {{"grid", 20'000, ""}};
  for (const char* order : {"grid", "scan", "shuffled"}) plan.imr.push_back({order, kMillion, ""});
  return plan;
}

/// Whole-mesh operations on meshes that a few milliseconds are enough for, too.
void add_quick(Plan& plan) {
  for (const std::int64_t size : {std::int64_t{10'000}, std::int64_t{100'000}}) {
    for (const char* order : {"grid", "scan", "shuffled"}) plan.large.push_back({order, size, ""});
  }
}

/// What bench/limits.py counts on: seven times as large as the cache that it simulates.
void add_counted(Plan& plan) {
  for (const char* order : {"grid", "shuffled"}) {
    plan.all.push_back({order, 400'000, ""});
    plan.large.push_back({order, 400'000, ""});
  }
}

Plan full_plan(std::int64_t largest) {
  Plan plan;
  add_orders(plan, 1'000, false);
  add_orders(plan, 10'000, true);
  add_orders(plan, 100'000, true);
  add_orders(plan, kMillion, false);
  add_orders(plan, 4 * kMillion, true);
  for (const char* order : {"grid", "scan", "shuffled"}) {
    plan.large.push_back({order, 4 * kMillion, ""});
  }
  // Ten thousand points and a million.
  plan.planar = {{"points", 20'000, ""}, {"points", 2 * kMillion, ""}};
  const DatasetKey reordered{"reordered", 4 * kMillion, ""};
  plan.all.push_back(reordered);
  plan.large.push_back(reordered);
  plan.all.push_back({"icosphere", 1'310'720, ""});
  plan.all.push_back({"fan", kMillion, ""});
  if (largest > 4 * kMillion) add_orders(plan, largest, false);
  for (const int per_mille : kMovedPerMille) {
    plan.disordered.push_back({"moved-" + std::to_string(per_mille), kMillion, ""});
  }
  return plan;
}

}  // namespace

std::int64_t largest_mesh() {
  constexpr std::size_t kNoLimit = std::size_t{1} << 60U;
  // That function takes four times the cache for three arrays.
  const std::size_t cache_bytes = 3 * baselines::stream_array_bytes(kNoLimit) / 4;
  const auto wanted = static_cast<std::int64_t>(10 * cache_bytes) / kTriangleBytes;
  const auto memory = static_cast<std::int64_t>(sysconf(_SC_PHYS_PAGES)) * sysconf(_SC_PAGESIZE);
  const std::int64_t possible = std::min(memory / 4 / kPeakTriangleBytes, kPatience);
  return std::min(wanted, possible) / kMillion * kMillion;
}

Plan make_plan(const PlanOptions& options) {
  const std::int64_t largest = options.largest > 0 ? options.largest : largest_mesh();
  Plan plan = options.is_smoke         ? smoke_plan()
              : options.is_represented ? represented_plan()
              : options.is_imr         ? imr_plan()
                                       : full_plan(largest);
  const bool is_full = !options.is_smoke && !options.is_represented && !options.is_imr;
  if (is_full && !options.is_recorded) add_quick(plan);
  if (!options.is_smoke && options.is_counted) add_counted(plan);
  plan.is_smoke = options.is_smoke;
  plan.threads = options.threads;
  std::ranges::sort(plan.threads);
  plan.threads.erase(std::ranges::unique(plan.threads).begin(), plan.threads.end());
  if (plan.threads.empty()) {
    plan.threads.push_back(1);
    const auto processors = static_cast<int>(std::thread::hardware_concurrency());
    if (processors > 1) plan.threads.push_back(processors);
  }
  if (options.is_represented) return plan;
  for (const std::string& mesh : options.meshes) {
    const std::int64_t face_count = read_soup(mesh).face_count();
    const DatasetKey key{std::filesystem::path(mesh).stem().string(), face_count, mesh};
    if (options.is_imr) {
      plan.imr.push_back(key);
      continue;
    }
    // The first is measured like the generated ones; the others for the builder's choice.
    if (&mesh == &options.meshes.front()) {
      plan.all.push_back(key);
      plan.with_peers.push_back(key);
      plan.large.push_back(key);
    }
    plan.disordered.push_back(key);
  }
  return plan;
}

}  // namespace hedgerow::bench
