#include "render/palette.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "hedgerow/query.h"
#include "table.h"

namespace hedgerow::tool {
namespace {

constexpr std::uint32_t kClay = 0xD9D2C7;
constexpr std::uint32_t kGrey = 0xC4C6CA;

// Fewer edges than regular are blue, more are red, the regular valence is the colour of paper.
constexpr std::array<std::uint32_t, 7> kDeviation = {0x2C4A9E, 0x5B8FD6, 0xA9CDF0, 0xEDE8DD,
                                                     0xF6B58A, 0xE0704F, 0xA32638};
constexpr int kRegular = 3;  // index of the deviation 0

constexpr std::array<std::uint32_t, 12> kDistinct = {0x4E79A7, 0xF28E2B, 0x59A14F, 0xE15759,
                                                     0x76B7B2, 0xEDC948, 0xB07AA1, 0xFF9DA7,
                                                     0x9C755F, 0x86BCB6, 0xD37295, 0x8CD17D};

struct DefectColour {
  DefectKind kind;
  std::uint32_t rrggbb;
};
constexpr std::array<DefectColour, 8> kDefects = {{{DefectKind::out_of_range, 0x000000},
                                                   {DefectKind::too_few_corners, 0x000000},
                                                   {DefectKind::repeated_vertex, 0x4A3728},
                                                   {DefectKind::duplicate_face, 0xE8A33D},
                                                   {DefectKind::nonmanifold_edge, 0xD6279B},
                                                   {DefectKind::inconsistent_edge, 0xE4572E},
                                                   {DefectKind::nonmanifold_vertex, 0x7B2CBF},
                                                   {DefectKind::isolated_vertex, 0x5F6B7A}}};
constexpr std::uint32_t kBoundary = 0x1F7A8C;
constexpr std::size_t kCrowd = 3000;  // more marks than this are drawn finer

std::vector<Vec3> linear(std::span<const std::uint32_t> colours) {
  std::vector<Vec3> out;
  for (const std::uint32_t colour : colours) out.push_back(linear_colour(colour));
  return out;
}

bool is_mostly_triangles(const Connectivity& mesh) {
  return mesh.visit([](const auto& view) {
    std::int64_t triangles = 0;
    for (Index f = 0; f < view.face_count(); ++f) triangles += view.degree(FaceId(f)) == 3 ? 1 : 0;
    return 2 * triangles >= view.face_count();
  });
}

/// Where a vertex of a defect is; its number is that of a moment inside the build.
std::optional<Vec3> place_of(const BuildFacts& facts, VertexId v) {
  const auto to_old = facts.built.vertices_new_to_old.span();
  if (v.valid() && v.value < facts.input.count) return to_vector(facts.input[v.value]);
  const auto at = static_cast<std::size_t>(v.value);
  if (v.valid() && at < to_old.size()) return to_vector(facts.input[to_old[at]]);
  return std::nullopt;
}

void mark_defect(const BuildFacts& facts, const Defect& defect, Palette& palette) {
  const std::uint32_t colour = kDefects[static_cast<std::size_t>(defect.kind)].rrggbb;
  const auto from = place_of(facts, defect.vertex);
  if (!from) return;
  if (defect.kind == DefectKind::nonmanifold_edge || defect.kind == DefectKind::inconsistent_edge) {
    if (const auto to = place_of(facts, defect.other)) {
      palette.marks.push_back({*from, *to, colour, 4});
    }
  } else {
    palette.marks.push_back({*from, *from, colour, 9});
  }
}

/// The faces of the input that are duplicates, in the numbers of the mesh that was built.
void colour_duplicates(const BuildFacts& facts, Palette& palette) {
  const auto to_old = facts.built.faces_new_to_old.span();
  palette.colours = {
      palette.plain,
      linear_colour(kDefects[static_cast<std::size_t>(DefectKind::duplicate_face)].rrggbb)};
  palette.of_face.assign(static_cast<std::size_t>(facts.built.mesh.face_count()), 0);
  for (const Defect& defect : facts.built.defects) {
    if (defect.kind != DefectKind::duplicate_face) continue;
    for (const Index input_face : {defect.face.value, static_cast<Index>(defect.value)}) {
      auto kept = static_cast<std::size_t>(input_face);
      if (!to_old.empty()) {
        const auto found = std::lower_bound(to_old.begin(), to_old.end(), input_face);
        if (found == to_old.end() || *found != input_face) continue;
        kept = static_cast<std::size_t>(found - to_old.begin());
      }
      if (kept < palette.of_face.size()) palette.of_face[kept] = 1;
    }
  }
}

std::int64_t mark_boundary(const Connectivity& mesh, Positions positions, Palette& palette) {
  std::int64_t count = 0;
  mesh.visit([&](const auto& view) {
    for (Index i = 0; i < view.halfedge_count(); ++i) {
      const HalfedgeId h(i);
      if (view.opposite[h].valid()) continue;
      palette.marks.push_back({to_vector(positions[view.origin[h].value]),
                               to_vector(positions[view.target(h).value]), kBoundary, 2});
      ++count;
    }
  });
  return count;
}

}  // namespace

Palette plain_palette(Shading shading) {
  Palette palette;
  palette.shading = shading;
  palette.plain = linear_colour(kClay);
  return palette;
}

Palette valence_palette(const Connectivity& mesh) {
  Palette palette = plain_palette(Shading::valence);
  const int regular = is_mostly_triangles(mesh) ? 6 : 4;
  palette.colours = linear(kDeviation);
  std::array<std::int64_t, kDeviation.size()> counts{};
  mesh.visit([&](const auto& view) {
    for (Index i = 0; i < view.vertex_count(); ++i) {
      const VertexId v(i);
      const int expected = is_boundary(view, v) ? regular / 2 + 1 : regular;
      const int edges = static_cast<int>(std::min<Index>(valence(view, v), 100));
      const int index = std::clamp(kRegular + edges - expected, 0, 2 * kRegular);
      palette.of_vertex.push_back(static_cast<std::uint8_t>(index));
      if (view.outgoing[v].valid()) ++counts[static_cast<std::size_t>(index)];
    }
  });
  for (std::size_t i = 0; i < kDeviation.size(); ++i) {
    const int deviation = static_cast<int>(i) - kRegular;
    const char* ends = i == 0 ? " or fewer" : i + 1 == kDeviation.size() ? " or more" : "";
    palette.legend.push_back(
        {kDeviation[i],
         fmt::format("valence {} ({} on the boundary){}: {} vertices", regular + deviation,
                     regular / 2 + 1 + deviation, ends, grouped(counts[i]))});
  }
  return palette;
}

Palette component_palette(const Connectivity& mesh, const Execution& execution) {
  Palette palette = plain_palette(Shading::components);
  palette.colours = linear(kDistinct);
  const Components components = connected_components(mesh, execution);
  const auto count = components.label.size();
  std::vector<std::int64_t> size_of(count);
  for (const Index label : components.label) {
    if (label >= 0) ++size_of[static_cast<std::size_t>(label)];
  }
  std::vector<Index> labels;
  for (std::size_t v = 0; v < count; ++v) {
    if (size_of[v] > 0) labels.push_back(static_cast<Index>(v));
  }
  std::ranges::stable_sort(labels, [&](Index a, Index b) {
    return size_of[static_cast<std::size_t>(a)] > size_of[static_cast<std::size_t>(b)];
  });
  std::vector<std::uint8_t> rank(count);
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const auto label = static_cast<std::size_t>(labels[i]);
    rank[label] = static_cast<std::uint8_t>(i % kDistinct.size());
    if (i < kDistinct.size()) {
      palette.legend.push_back(
          {kDistinct[i], fmt::format("component {}: {} vertices", i + 1, grouped(size_of[label]))});
    }
  }
  for (const Index label : components.label) {
    palette.of_vertex.push_back(label < 0 ? std::uint8_t{0}
                                          : rank[static_cast<std::size_t>(label)]);
  }
  return palette;
}

Palette defect_palette(const BuildFacts& facts, Positions positions) {
  Palette palette = plain_palette(Shading::defects);
  palette.plain = linear_colour(kGrey);
  const std::int64_t boundary = mark_boundary(facts.built.mesh, positions, palette);
  if (boundary > 0) {
    palette.legend.push_back(
        {kBoundary, fmt::format("{} half-edges without opposite", grouped(boundary))});
  }
  for (const Defect& defect : facts.built.defects) mark_defect(facts, defect, palette);
  if (palette.marks.size() > kCrowd) {
    for (Mark& mark : palette.marks) mark.width *= 0.5F;
  }
  colour_duplicates(facts, palette);
  for (std::size_t kind = 0; kind < kDefectKindCount; ++kind) {
    const std::int64_t count = facts.built.stats.defect_count[kind];
    if (count == 0) continue;
    palette.legend.push_back(
        {kDefects[kind].rrggbb, fmt::format("{}: {}{}", name(static_cast<DefectKind>(kind)),
                                            grouped(count), kind < 2 ? " (not drawn)" : "")});
  }
  return palette;
}

Palette make_palette(Shading shading, const BuildFacts& facts, Positions positions,
                     const Execution& execution) {
  switch (shading) {
    case Shading::valence:
      return valence_palette(facts.built.mesh);
    case Shading::components:
      return component_palette(facts.built.mesh, execution);
    case Shading::defects:
      return defect_palette(facts, positions);
    default:
      return plain_palette(shading);
  }
}

Json legend_json(const Palette& palette) {
  Json legend = Json::array();
  for (const LegendEntry& entry : palette.legend) {
    legend.push_back(
        {{"colour", fmt::format("#{:06x}", entry.rrggbb)}, {"meaning", entry.meaning}});
  }
  return legend;
}

}  // namespace hedgerow::tool
