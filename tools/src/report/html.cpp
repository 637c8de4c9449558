#include "report/html.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "build_info.h"
#include "report/html_style.h"
#include "table.h"

namespace hedgerow::tool {
namespace {

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t block = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const unsigned byte = i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0;
      block = block << 8U | byte;
    }
    for (std::size_t k = 0; k < 4; ++k) {
      const bool is_padding = i + k > bytes.size();
      out += is_padding ? '=' : kDigits[block >> (18 - 6 * k) & 63U];
    }
  }
  return out;
}

std::string title_of(const Stage& stage) {
  return escaped(stage.name + (stage.variant.empty() ? "" : " (" + stage.variant + ")"));
}

/// The measurements on most threads, in their order.
std::vector<const Stage*> widest(const std::vector<Stage>& stages) {
  int threads = 0;
  for (const Stage& stage : stages) threads = std::max(threads, stage.threads);
  std::vector<const Stage*> out;
  for (const Stage& stage : stages) {
    const bool has_wider =
        stage.threads < threads && std::ranges::any_of(stages, [&](const Stage& other) {
          return other.name == stage.name && other.variant == stage.variant &&
                 other.threads == threads;
        });
    if (!has_wider) out.push_back(&stage);
  }
  return out;
}

/// One row of a plot: a label, one or two bars as shares of the whole width, and a number.
std::string bar_row(const std::string& label, double share, double second,
                    std::string_view number) {
  const auto percent = [](double part) { return 100 * std::clamp(part, 0.0, 1.0); };
  std::string bars = fmt::format("<rect class=\"bar\" width=\"{:.2f}\" height=\"{}\" y=\"0\"/>",
                                 percent(share), second > 0 ? 6 : 10);
  if (second > 0) {
    bars += fmt::format("<rect class=\"bar2\" width=\"{:.2f}\" height=\"4\" y=\"6\"/>",
                        percent(second));
  }
  return fmt::format(
      "<span>{}</span><svg viewBox=\"0 0 100 10\" preserveAspectRatio=\"none\" role=\"img\" "
      "aria-label=\"{}\"><line class=\"axis\" x1=\"0\" y1=\"10\" x2=\"100\" y2=\"10\"/>{}</svg>"
      "<i>{}</i>\n",
      label, number, bars, number);
}

std::string speed_plot(const std::vector<const Stage*>& stages) {
  double most = 1;
  for (const Stage* stage : stages) {
    if (stage->pointer_ms && stage->ms > 0) most = std::max(most, *stage->pointer_ms / stage->ms);
  }
  std::string rows;
  for (const Stage* stage : stages) {
    if (!stage->pointer_ms || stage->ms <= 0) continue;
    const double speed = *stage->pointer_ms / stage->ms;
    const double structs = stage->aos_ms.value_or(0) / stage->ms;
    rows += bar_row(title_of(*stage), speed / most, structs / most, short_text(speed) + "x");
  }
  if (rows.empty()) return {};
  return "<h2>Against the pointer mesh</h2>\n<p class=\"soft\">Its time on one thread divided by "
         "ours; the thin bar is the array-of-structs mesh.</p>\n<div class=\"plot\">\n" +
         rows + "</div>\n";
}

std::string bandwidth_plot(const std::vector<const Stage*>& stages, const Bandwidth& bandwidth) {
  std::string rows;
  for (const Stage* stage : stages) {
    const double share = stage->share_of(bandwidth);
    rows += bar_row(title_of(*stage), share, 0, fmt::format("{:.0f} %", 100 * share));
  }
  return "<h2>Share of the memory bandwidth</h2>\n<p class=\"soft\">Bytes that had to move, "
         "divided by the time and by what this machine moves in the same mix of reads and "
         "writes. More than 100 %: the caches held it.</p>\n"
         "<div class=\"plot\">\n" +
         rows + "</div>\n";
}

std::string stage_table(const ReportResult& result) {
  std::string rows;
  const auto ratio = [](const std::optional<double>& other, double ms) {
    return other && ms > 0 ? short_text(*other / ms) + "x" : std::string("-");
  };
  for (const Stage& stage : result.stages) {
    rows += fmt::format(
        "<tr><td>{}</td><td class=\"word\">{}</td><td>{}</td><td>{}</td><td>{}</td>"
        "<td class=\"word\">{}</td><td>{}</td><td>{:.0f} %</td><td>{}</td><td>{}</td><td>{}</td>"
        "</tr>\n",
        escaped(stage.name), escaped(stage.variant), stage.threads, short_text(stage.ms),
        short_text(stage.ns_per_element()), escaped(stage.unit), short_text(stage.gb_per_s()),
        100 * stage.share_of(result.bandwidth), ratio(stage.pointer_ms, stage.ms),
        ratio(stage.aos_ms, stage.ms), stage.checked ? "yes" : "no");
  }
  return "<h2>All measurements</h2>\n<div class=\"wide\"><table><thead><tr><th>stage</th>"
         "<th class=\"word\">variant</th><th>threads</th><th>ms</th><th>ns each</th>"
         "<th class=\"word\">element</th><th>GB/s</th><th>of bandwidth</th><th>vs pointer</th>"
         "<th>vs AoS</th><th>checked</th></tr></thead><tbody>\n" +
         rows + "</tbody></table></div>\n";
}

using Facts = std::vector<std::pair<std::string, std::string>>;

std::string fact_table(std::string_view title, const Facts& facts) {
  std::string rows;
  for (const auto& [name, value] : facts) {
    rows += fmt::format("<tr><td>{}</td><td>{}</td></tr>\n", escaped(name), escaped(value));
  }
  return fmt::format(
      "<h2>{}</h2>\n<div class=\"wide\"><table class=\"facts\"><tbody>\n{}</tbody>"
      "</table></div>\n",
      title, rows);
}

Facts mesh_facts(const Inspection& inspection) {
  const Summary& summary = inspection.summary;
  const auto or_dash = [](const std::optional<std::int64_t>& value) {
    return value ? grouped(*value) : std::string("not defined");
  };
  return {{"vertices", grouped(summary.vertices)},
          {"faces", fmt::format("{}: {} triangles, {} quads, {} with more corners",
                                grouped(summary.faces), grouped(summary.triangles),
                                grouped(summary.quads), grouped(summary.polygons))},
          {"edges",
           fmt::format("{}: {} boundary, {} non-manifold, {} inconsistent",
                       grouped(summary.edge_counts.edges), grouped(summary.edge_counts.boundary),
                       grouped(summary.edge_counts.nonmanifold),
                       grouped(summary.edge_counts.inconsistent))},
          {"components", grouped(summary.components)},
          {"boundary loops", or_dash(summary.boundary_loops)},
          {"genus", or_dash(summary.genus)},
          {"defects", grouped(static_cast<std::int64_t>(inspection.defects.size()))},
          {"connectivity", byte_text(inspection.connectivity_bytes)},
          {"digest", fmt::format("{:016x}", inspection.digest)}};
}

Facts machine_facts(const ReportResult& result) {
  const BuildInfo& build = build_info();
  const Machine& machine = result.machine;
  Facts facts = {
      {"processor", fmt::format("{}, {} cores", machine.cpu, machine.cores)},
      {"memory",
       fmt::format("{}; reads {} GB/s, copies {}, triad {}", byte_text(machine.memory_bytes),
                   short_text(result.bandwidth.read_gb_s), short_text(result.bandwidth.copy_gb_s),
                   short_text(result.bandwidth.triad_gb_s))},
      {"system", machine.os},
      {"compiler", fmt::format("{}, {}", build.compiler, build.build_type)},
      {"flags", std::string(build.flags)},
      {"hedgerow", fmt::format("{}, commit {}", build.version, build.commit)}};
  if (result.rays.embree_version != 0) {
    facts.emplace_back("ray tracer", "Embree " + embree_version_text(result.rays));
  }
  return facts;
}

std::string tiles(const ReportResult& result, const std::vector<const Stage*>& stages) {
  std::string out = fmt::format(
      "<div class=\"tile\"><b>{}</b><span>faces</span></div>\n"
      "<div class=\"tile\"><b>{}</b><span>half-edges</span></div>\n",
      grouped(result.inspection.summary.faces), grouped(result.inspection.summary.halfedges));
  constexpr std::array<std::pair<std::string_view, std::string_view>, 4> kShown = {
      {{"build", "to build, each half-edge"},
       {"vertex_normals_halfedge", "a vertex normal"},
       {"one_ring", "a one-ring"},
       {"hit_connectivity", "normal and ring at a hit"}}};
  for (const auto& [name, label] : kShown) {
    const auto found = std::ranges::find_if(stages, [wanted = name](const Stage* stage) {
      return stage->name == wanted && stage->variant != "uniform";
    });
    if (found == stages.end()) continue;
    out += fmt::format("<div class=\"tile\"><b>{} ns</b><span>{}</span></div>\n",
                       short_text((*found)->ns_per_element()), label);
  }
  return "<div class=\"tiles\">\n" + out + "</div>\n";
}

std::string verdict(const ReportResult& result) {
  if (result.failed.empty()) {
    const auto checked = std::ranges::count_if(result.stages, &Stage::checked);
    return fmt::format("<p class=\"good\">{} of {} measurements checked, none wrong</p>\n", checked,
                       result.stages.size());
  }
  std::string names;
  for (const std::string& name : result.failed) names += (names.empty() ? "" : ", ") + name;
  return fmt::format("<p class=\"bad\">Wrong answers, not timed: {}</p>\n", escaped(names));
}

}  // namespace

std::string report_html(const ReportResult& result, const std::string& png) {
  const std::vector<const Stage*> stages = widest(result.stages);
  std::string out = fmt::format(
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">\n"
      "<title>Hedgerow report: {}</title>\n<style>{}</style></head>\n<body><main>\n"
      "<p class=\"soft\">hedgerow {} report</p>\n<h1>{}</h1>\n",
      escaped(result.mesh_name), kReportStyle, build_info().version, escaped(result.mesh_name));
  out += verdict(result);
  out += tiles(result, stages);
  if (!png.empty()) {
    out += fmt::format("<img alt=\"The mesh\" src=\"data:image/png;base64,{}\">\n", base64(png));
  }
  out += speed_plot(stages);
  out += bandwidth_plot(stages, result.bandwidth);
  out += stage_table(result);
  if (const std::string rays = rays_text(result.rays); !rays.empty()) {
    out += fmt::format("<p class=\"soft\">{}</p>\n", escaped(rays));
  }
  out += fact_table("The mesh", mesh_facts(result.inspection));
  out += fact_table("The machine", machine_facts(result));
  return out + "</main></body></html>\n";
}

}  // namespace hedgerow::tool
