#include <algorithm>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "inspection.h"
#include "table.h"
#include "terminal.h"

namespace hedgerow::tool {
namespace {

constexpr std::size_t kPrintedDefects = 20;

std::string or_dash(const std::optional<std::int64_t>& value) {
  return value ? grouped(*value) : "-";
}

std::string yes_no(bool is_so) { return is_so ? "yes" : "no"; }

/// Two columns of name and number side by side keep the table on one screen.
class SideBySide {
 public:
  void left(std::string name, std::string value) {
    left_.emplace_back(std::move(name), std::move(value));
  }
  void right(std::string name, std::string value) {
    right_.emplace_back(std::move(name), std::move(value));
  }
  [[nodiscard]] std::string text(bool colour) const {
    Table table(
        {{"elements", Table::Align::left}, {""}, {"  "}, {"surface", Table::Align::left}, {""}});
    for (std::size_t i = 0; i < std::max(left_.size(), right_.size()); ++i) {
      const auto& [left_name, left_value] = i < left_.size() ? left_[i] : kNothing;
      const auto& [right_name, right_value] = i < right_.size() ? right_[i] : kNothing;
      table.add({left_name, left_value, "", right_name, right_value});
    }
    return table.text(colour);
  }

 private:
  using Line = std::pair<std::string, std::string>;
  inline static const Line kNothing;
  std::vector<Line> left_;
  std::vector<Line> right_;
};

std::string counts_text(const Inspection& inspection, bool colour) {
  const Summary& summary = inspection.summary;
  SideBySide table;
  table.left("vertices", grouped(summary.vertices));
  table.left("faces", grouped(summary.faces));
  table.left("  triangles", grouped(summary.triangles));
  table.left("  quads", grouped(summary.quads));
  table.left("  polygons", grouped(summary.polygons));
  table.left("half-edges", grouped(summary.halfedges));
  table.left("edges", grouped(summary.edge_counts.edges));
  table.left("  boundary", grouped(summary.edge_counts.boundary));
  table.left("  non-manifold", grouped(summary.edge_counts.nonmanifold));
  table.left("  inconsistent", grouped(summary.edge_counts.inconsistent));
  table.left("isolated vertices", grouped(summary.isolated_vertices));
  table.left("non-manifold vertices", grouped(summary.nonmanifold_vertices));

  table.right("closed", yes_no(summary.is_closed()));
  table.right("manifold", yes_no(summary.is_manifold()));
  table.right("oriented", yes_no(summary.is_oriented()));
  table.right("components", grouped(summary.components));
  table.right("Euler characteristic", grouped(summary.euler));
  table.right("boundary loops", or_dash(summary.boundary_loops));
  table.right("genus", or_dash(summary.genus));
  table.right("valence, least", summary.valence ? grouped(summary.valence->min) : "-");
  table.right("valence, mean", summary.valence ? short_text(summary.valence->mean) : "-");
  table.right("valence, most", summary.valence ? grouped(summary.valence->max) : "-");
  table.right("faces of no area", grouped(inspection.zero_area_faces));
  table.right("duplicate faces", grouped(summary.duplicate_faces));
  table.right("degenerate faces (dropped)", grouped(inspection.degenerate_faces));
  return table.text(colour);
}

std::string cost_text(const Inspection& inspection, bool colour) {
  const double per_face = inspection.summary.faces == 0
                              ? 0
                              : static_cast<double>(inspection.connectivity_bytes) /
                                    static_cast<double>(inspection.summary.faces);
  Table table({{"cost", Table::Align::left}, {""}, {"", Table::Align::left}});
  table.add({"read", time_text(inspection.read_ms)});
  table.add({"build", time_text(inspection.build_ms)});
  table.add({"validate", time_text(inspection.validate_ms),
             inspection.violation_count == 0
                 ? "every invariant holds"
                 : fmt::format("{} VIOLATIONS", grouped(inspection.violation_count))});
  table.add({"connectivity", byte_text(inspection.connectivity_bytes),
             fmt::format("{} bytes a face", short_text(per_face))});
  table.add({"peak memory", byte_text(inspection.peak_bytes)});
  return table.text(colour) + fmt::format("\ndigest  {:016x}\n", inspection.digest);
}

std::string defects_text(const Buffer<Defect>& defects, bool colour) {
  if (defects.empty()) return styled("no defects", Style::good, colour) + '\n';
  Table table({{"defect", Table::Align::left}, {"where", Table::Align::left}});
  const std::size_t count = std::min(kPrintedDefects, defects.size());
  for (std::size_t i = 0; i < count; ++i) {
    table.add({name(defects[i].kind), defect_text(defects[i])});
  }
  std::string out = table.text(colour);
  if (defects.size() > count) {
    out += fmt::format("... and {} more\n",
                       grouped(static_cast<std::int64_t>(defects.size() - count)));
  }
  return out;
}

}  // namespace

std::string inspection_text(const Inspection& inspection, bool colour) {
  return counts_text(inspection, colour) + '\n' + cost_text(inspection, colour) + '\n' +
         defects_text(inspection.defects, colour);
}

}  // namespace hedgerow::tool
