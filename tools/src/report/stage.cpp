#include "report/stage.h"

#include <string_view>

#include <fmt/format.h>

#include "table.h"
#include "terminal.h"

namespace hedgerow::tool {
namespace {

double reference(Mix mix, const Bandwidth& bandwidth) {
  switch (mix) {
    case Mix::read:
      return bandwidth.read_gb_s;
    case Mix::copy:
      return bandwidth.copy_gb_s;
    case Mix::triad:
      return bandwidth.triad_gb_s;
  }
  return bandwidth.copy_gb_s;
}

const char* mix_name(Mix mix) {
  switch (mix) {
    case Mix::read:
      return "read";
    case Mix::copy:
      return "copy";
    case Mix::triad:
      return "triad";
  }
  return "copy";
}

std::string_view group_of(const std::string& name) {
  if (name.find("normals") != std::string::npos) return "normals";
  if (name.starts_with("bvh_") || name.starts_with("rays_") || name == "hit_connectivity") {
    return "rays";
  }
  if (name == "one_ring" || name == "boundary_loops" || name == "components") return "queries";
  return "mesh";
}

Json or_null(const std::optional<double>& number) { return number ? Json(*number) : Json(nullptr); }

std::string speed_up(const std::optional<double>& other_ms, double ms) {
  return other_ms && ms > 0 ? short_text(*other_ms / ms) + "x" : "-";
}

}  // namespace

double Stage::ns_per_element() const noexcept {
  return elements == 0 ? 0 : ms * 1e6 / static_cast<double>(elements);
}

double Stage::gb_per_s() const noexcept {
  return ms == 0 ? 0 : static_cast<double>(bytes) / (ms * 1e6);
}

double Stage::share_of(const Bandwidth& bandwidth) const noexcept {
  const double possible = reference(mix, bandwidth);
  return possible == 0 ? 0 : gb_per_s() / possible;
}

Json stage_json(const Stage& stage, const Bandwidth& bandwidth) {
  Json json;
  json["name"] = stage.name;
  json["variant"] = stage.variant.empty() ? Json(nullptr) : Json(stage.variant);
  json["threads"] = stage.threads;
  json["ms"] = stage.ms;
  json["elements"] = stage.elements;
  json["unit"] = stage.unit;
  json["ns_per_element"] = stage.ns_per_element();
  json["bytes"] = stage.bytes;
  json["gb_per_s"] = stage.gb_per_s();
  json["share_of_bandwidth"] = stage.share_of(bandwidth);
  json["pointer_ms"] = or_null(stage.pointer_ms);
  json["aos_ms"] = or_null(stage.aos_ms);
  json["checked"] = stage.checked;
  json["bandwidth_mix"] = mix_name(stage.mix);
  json["runs"] = stage.runs;
  return json;
}

std::string stages_text(const std::vector<Stage>& stages, const Bandwidth& bandwidth, bool colour) {
  std::string out;
  for (const std::string_view group : {"mesh", "normals", "queries", "rays"}) {
    Table table({{std::string(group), Table::Align::left},
                 {"variant", Table::Align::left},
                 {"threads"},
                 {"ms"},
                 {"ns/element"},
                 {"element", Table::Align::left},
                 {"GB/s"},
                 {"of"},
                 {"", Table::Align::left},
                 {"vs pointer"},
                 {"vs AoS"},
                 {"checked", Table::Align::left}});
    for (const Stage& stage : stages) {
      if (group_of(stage.name) != group) continue;
      table.add({stage.name, stage.variant, fmt::format("{}", stage.threads), short_text(stage.ms),
                 short_text(stage.ns_per_element()), stage.unit, short_text(stage.gb_per_s()),
                 fmt::format("{:.0f}%", 100 * stage.share_of(bandwidth)), mix_name(stage.mix),
                 speed_up(stage.pointer_ms, stage.ms), speed_up(stage.aos_ms, stage.ms),
                 stage.checked ? "yes" : "no"});
    }
    if (!table.empty()) out += table.text(colour) + '\n';
  }
  return out;
}

}  // namespace hedgerow::tool
