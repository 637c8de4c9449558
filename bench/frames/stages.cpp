#include "frames/stages.h"

#include <algorithm>
#include <cstring>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <tbb/info.h>
#include <tbb/task_arena.h>

#include "frames/rays.h"
#include "hedgerow/dirty_normals.h"
#include "hedgerow/normals.h"
#include "hedgerow/reorder.h"
#include "hedgerow/shapes.h"

namespace hedgerow::bench {
namespace {

constexpr std::int64_t kUint16Vertices = 65'536;

std::vector<int> thread_counts() {
  const int all = tbb::info::default_concurrency();
  return all > 1 ? std::vector<int>{1, all} : std::vector<int>{1};
}

/// Calls `function(execution, "2 threads")` for one thread and for all.
template <class Function>
void for_threads(const Function& function) {
  for (const int count : thread_counts()) {
    tbb::task_arena arena(count);
    const Execution execution = count == 1 ? Execution::serial() : Execution::in(arena);
    function(execution, fmt::format("{} thread{}", count, count == 1 ? "" : "s"));
  }
}

double mega_per_second(std::int64_t count, double ms) {
  return static_cast<double>(count) / ms / 1e3;
}

NormalsOut out_of(Buffer<float>& normals) {
  return {normals.data(), static_cast<std::int64_t>(normals.size() / 3)};
}

void import_list(Rows& rows, const FrameOptions& options, const FaceList& faces, const char* what) {
  for_threads([&](const Execution& execution, const std::string& threads) {
    BuildWorkspace workspace;
    BuildOptions build_options;
    build_options.borrow_corners = true;
    build_options.workspace = &workspace;
    std::size_t bytes = 0;
    const double ms = best_ms(options.runs, [&] {
      const auto built = build(faces, build_options, execution);
      bytes = built ? built->mesh.bytes() : 0;
    });
    if (bytes == 0) rows.fail(fmt::format("S0 {}", what));
    rows.add({"S0", what, threads, mega_per_second(faces.face_count, ms), "Mfaces/s",
              fmt::format("{:.2f} bytes a half-edge",
                          static_cast<double>(bytes) / static_cast<double>(faces.corner_count()))});
  });
}

}  // namespace

void measure_import(Rows& rows, const Subject& subject, const FrameOptions& options) {
  import_list(rows, options, subject.soup.face_list(), "build, order of the file");
  const Soup shuffled = shapes::shuffled(subject.soup, 3);
  import_list(rows, options, shuffled.face_list(), "build, shuffled");
  const auto ordered = reorder(subject.mesh, subject.soup.positions(), ReorderMethod::vertex_cache,
                               Execution::serial());
  if (ordered) import_list(rows, options, face_list(ordered->mesh), "build, vertex-cache order");
  if (subject.vertices() < kUint16Vertices && subject.soup.offsets.empty()) {
    std::vector<std::uint16_t> corners;
    for (const Index v : subject.soup.corners) corners.push_back(static_cast<std::uint16_t>(v));
    import_list(rows, options, FaceList::triangles<std::uint16_t>(corners, subject.vertices()),
                "build, 16-bit indices");
  }
}

void measure_normals(Rows& rows, const Subject& subject, const FrameOptions& options) {
  Buffer<float> xyz = Buffer<float>::copy_of(subject.soup.xyz.span());
  Buffer<float> normals(xyz.size());
  Buffer<float> full(xyz.size());
  Workspace workspace;
  const Positions positions{xyz.data(), subject.vertices()};
  DirtySet dirty(subject.mesh);
  for_threads([&](const Execution& execution, const std::string& threads) {
    const auto add = [&](const char* what, double ms) {
      rows.add(
          {"S2", what, threads, ms, "ms",
           fmt::format("{:.2f} ns a vertex", ms * 1e6 / static_cast<double>(subject.vertices()))});
    };
    for (const auto& [weight, word] :
         {std::pair{NormalWeight::area, "area"}, std::pair{NormalWeight::angle, "angle"}}) {
      NormalOptions with;
      with.weight = weight;
      add(fmt::format("gather, {}", word).c_str(), best_ms(options.runs, [&] {
            (void)gather_vertex_normals(subject.mesh, positions, out_of(full), with, execution,
                                        workspace);
          }));
      add(fmt::format("scatter, {}", word).c_str(), best_ms(options.runs, [&] {
            (void)scatter_vertex_normals(subject.soup.face_list(), positions, out_of(normals), with,
                                         execution, workspace);
          }));
      if (std::memcmp(full.data(), normals.data(), full.size_bytes()) != 0) {
        rows.fail("S2: gather and scatter differ");
      }
      deform(subject, subject.blob, 1, xyz);
      add(fmt::format("1% moved, {}", word).c_str(), best_ms(options.runs, [&] {
            (void)dirty.find(subject.mesh, MovedVertices::list(subject.blob));
            (void)update_vertex_normals(subject.mesh, positions, out_of(normals), with, dirty,
                                        execution, workspace);
          }));
      (void)gather_vertex_normals(subject.mesh, positions, out_of(full), with, execution,
                                  workspace);
      if (std::memcmp(full.data(), normals.data(), full.size_bytes()) != 0) {
        rows.fail("S2: a dirty update differs from a full pass");
      }
      std::ranges::copy(subject.soup.xyz, xyz.begin());
    }
  });
}

void measure_rays(Rows& rows, const Subject& subject, const FrameOptions& options) {
  const auto device = ray::Device::create();
  const auto scene = ray::Scene::build(
      *device, subject.mesh, ray::PaddedPositions::of(subject.soup.xyz), {}, Execution::serial());
  const Packets primary = primary_rays(subject, options.still_rays);
  std::vector<ray::HitPacket> hits(primary.size());
  const auto add = [&](const char* what, const char* variant, std::int64_t count, double ms,
                       std::int64_t met) {
    rows.add({"S4", what, variant, mega_per_second(count, ms), "Mrays/s",
              fmt::format("{} rays, {:.1f} % met", count,
                          100 * static_cast<double>(met) / static_cast<double>(count))});
  };
  const auto trace = [&](const Packets& packets, ray::Coherence coherence) {
    hits.resize(packets.size());
    for (std::size_t i = 0; i < packets.size(); ++i)
      hits[i] = scene->intersect(packets[i], coherence);
  };
  double ms = best_ms(options.runs, [&] { trace(primary, ray::Coherence::coherent); });
  add("primary", "8 at a time", count_rays(primary), ms, count_hits(hits));
  const std::int64_t wrong =
      wrong_hits(subject, subject.soup.xyz, primary, hits, affordable_sample(subject));
  if (wrong > 0) rows.fail(fmt::format("S4: {} rays met the wrong face", wrong));
  const std::vector<ray::HitPacket> primary_hits = hits;
  std::int64_t met = 0;
  ms = best_ms(options.runs, [&] {
    met = 0;
    for (const ray::RayPacket& packet : primary) {
      for (std::size_t k = 0; k < 8; ++k) {
        met += scene->intersect(ray_of(packet, k), ray::Coherence::coherent).valid() ? 1 : 0;
      }
    }
  });
  add("primary", "1 at a time", count_rays(primary), ms, met);

  const Packets bounce = scattered_rays(subject, *scene, primary, primary_hits, 1, 10);
  if (!bounce.empty()) {
    ms = best_ms(options.runs, [&] { trace(bounce, ray::Coherence::incoherent); });
    add("diffuse bounce", "8 at a time", count_rays(bounce), ms, count_hits(hits));
  }
  const Packets occlusion = scattered_rays(subject, *scene, primary, primary_hits, 4, 0.05F);
  if (!occlusion.empty()) {
    ms = best_ms(options.runs, [&] {
      met = 0;
      for (const ray::RayPacket& packet : occlusion) {
        const auto found = scene->is_occluded(packet, ray::Coherence::incoherent);
        met += std::ranges::count(found, true);
      }
    });
    add("occlusion, 5% of the diagonal", "8 at a time", count_rays(occlusion), ms, met);
  }
  const std::vector<ray::Vec3> points = random_points(subject, 20'000);
  for (const auto& [radius, name] :
       {std::pair{0.01F * subject.diagonal, "radius 1%"}, std::pair{1e30F, "any radius"}}) {
    ms = best_ms(1, [&, reach = radius] {
      met = 0;
      for (const ray::Vec3& point : points)
        met += scene->closest_point(point, reach).valid() ? 1 : 0;
    });
    add("closest point", name, std::ssize(points), ms, met);
  }
}

}  // namespace hedgerow::bench
