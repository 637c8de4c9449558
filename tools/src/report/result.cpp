#include "report/result.h"

#include <algorithm>

#include <fmt/format.h>

#include "build_info.h"
#include "report/timing.h"
#include "table.h"
#include "terminal.h"

namespace hedgerow::tool {
namespace {

const Stage* find_stage(const std::vector<Stage>& stages, std::string_view name) {
  const Stage* found = nullptr;
  for (const Stage& stage : stages) {
    const bool is_better = found == nullptr || stage.threads > found->threads;
    if (stage.name == name && (stage.variant.empty() || stage.variant == "area") && is_better) {
      found = &stage;
    }
  }
  return found;
}

/// "build 12.3x" for the stage on most threads, or nothing.
std::string ratio_text(const std::vector<Stage>& stages, std::string_view name,
                       std::string_view label) {
  const Stage* stage = find_stage(stages, name);
  if (stage == nullptr || !stage->pointer_ms || stage->ms == 0) return {};
  return fmt::format("{} {}x", label, short_text(*stage->pointer_ms / stage->ms));
}

std::string verdict(const ReportResult& result, bool colour) {
  if (!result.failed.empty()) {
    std::string names;
    for (const std::string& name : result.failed) {
      names += fmt::format("{}{}", names.empty() ? "" : ", ", name);
    }
    return styled("WRONG ANSWERS", Style::error, colour) + " (not timed): " + names + '\n';
  }
  const auto checked = std::count_if(result.stages.begin(), result.stages.end(),
                                     [](const Stage& stage) { return stage.checked; });
  std::string ratios;
  for (const std::string& ratio :
       {ratio_text(result.stages, "build", "build"),
        ratio_text(result.stages, "vertex_normals_facelist", "normals by face list"),
        ratio_text(result.stages, "vertex_normals_halfedge", "normals by half-edge")}) {
    if (!ratio.empty()) ratios += fmt::format("{}{}", ratios.empty() ? "" : ", ", ratio);
  }
  return fmt::format(
      "{}: {} of {} measurements checked, none wrong; against the pointer mesh: {}\n",
      styled("verdict", Style::good, colour), checked, result.stages.size(),
      ratios.empty() ? "not compared" : ratios);
}

std::string joined(const std::vector<std::string>& words) {
  std::string out;
  for (const std::string& word : words) out += (out.empty() ? "" : ", ") + word;
  return out;
}

std::string bandwidth_text(const baselines::Bandwidth& bandwidth, bool colour) {
  Table table({{"memory bandwidth", Table::Align::left}, {"GB/s"}});
  table.add({"read", short_text(bandwidth.read_gb_s)});
  table.add({"copy", short_text(bandwidth.copy_gb_s)});
  table.add({"triad", short_text(bandwidth.triad_gb_s)});
  return table.text(colour) +
         fmt::format("{} thread{}, arrays of {}, best pass\n", bandwidth.threads,
                     bandwidth.threads == 1 ? "" : "s",
                     byte_text(static_cast<std::int64_t>(bandwidth.array_bytes)));
}

}  // namespace

std::vector<std::string> absent_parts() {
#if HEDGEROW_HAS_RAY
  return {};
#else
  return {"bvh_build",      "bvh_refit",        "rays_primary",
          "rays_occlusion", "hit_connectivity", "render.png"};
#endif
}

Json report_json(const ReportResult& result) {
  Json stages = Json::array();
  for (const Stage& stage : result.stages) stages.push_back(stage_json(stage, result.bandwidth));
  Json json;
  json["version"] = build_info().version;
  json["commit"] = build_info().commit;
  json["machine"] = machine_json(result.machine);
  json["bandwidth_gb_s"] = {{"read", result.bandwidth.read_gb_s},
                            {"copy", result.bandwidth.copy_gb_s},
                            {"triad", result.bandwidth.triad_gb_s}};
  json["mesh_name"] = result.mesh_name;
  json["mesh"] = inspection_json(result.inspection);
  json["stages"] = std::move(stages);
  json["rays"] = rays_json(result.rays);
  json["absent"] = absent_parts();
  json["failed"] = result.failed;
  json["files"] = result.files;
  return json;
}

std::string report_text(const ReportResult& result, bool colour) {
  std::string out =
      fmt::format("hedgerow {} report on {}\n\n", build_info().version, result.mesh_name);
  out += machine_text(result.machine, colour) + '\n';
  out += bandwidth_text(result.bandwidth, colour) + '\n';
  out += inspection_text(result.inspection, colour) + '\n';
  out += stages_text(result.stages, result.bandwidth, colour);
  out += fmt::format(
      "ms: median of {} to {} runs. GB/s: bytes that had to move, and their share of the bandwidth "
      "named.\nvs pointer, vs AoS: their time on one thread divided by ours; their vertex normals "
      "include face normals.\n",
      kMinRuns, kMaxRuns);
  out += rays_text(result.rays);
  if (const auto absent = absent_parts(); !absent.empty()) {
    out += fmt::format("absent from this version: {}\n", joined(absent));
  }
  out += fmt::format("wrote {}\n", joined(result.files));
  return out + verdict(result, colour);
}

}  // namespace hedgerow::tool
