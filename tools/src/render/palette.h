#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "hedgerow/build.h"
#include "hedgerow/connectivity.h"
#include "hedgerow/positions.h"
#include "render/image.h"
#include "render/vector.h"
#include "run.h"

namespace hedgerow::tool {

enum class Shading : std::uint8_t { smooth, flat, normals, valence, components, defects };

/// One colour of a picture and what it stands for.
struct LegendEntry {
  std::uint32_t rrggbb = 0;
  std::string meaning;
};

/// A line or a dot to draw over the picture.
struct Mark {
  Vec3 from{};
  Vec3 to{};
  std::uint32_t rrggbb = 0;
  float width = 2;  ///< pixels; of a dot (from = to) its diameter
};

/// What colours the elements of one mesh have under one shading.
struct Palette {
  Shading shading = Shading::smooth;
  Vec3 plain{};                         ///< where neither of the next two says otherwise
  std::vector<std::uint8_t> of_vertex;  ///< index into `colours`; empty: not by vertex
  std::vector<std::uint8_t> of_face;    ///< the same; 0 is `plain`
  std::vector<Vec3> colours;
  std::vector<Mark> marks;
  std::vector<LegendEntry> legend;
};

/// What a picture of the defects has to know of the build.
struct BuildFacts {
  const BuildOutput& built;
  Positions input;  ///< the positions before the build
};

/// Colours by valence: how far each vertex is from the regular one (6 in triangle meshes, 4 where
/// most faces have more corners; 4 and 3 on the boundary).
[[nodiscard]] Palette valence_palette(const Connectivity& mesh);
/// A colour for each connected component, the one with the most vertices first.
[[nodiscard]] Palette component_palette(const Connectivity& mesh, const Execution& execution);
/// Defects on a plain grey mesh: lines, dots and faces.
[[nodiscard]] Palette defect_palette(const BuildFacts& facts, Positions positions);
[[nodiscard]] Palette plain_palette(Shading shading);

/// The palette of `shading`.
[[nodiscard]] Palette make_palette(Shading shading, const BuildFacts& facts, Positions positions,
                                   const Execution& execution);

[[nodiscard]] Json legend_json(const Palette& palette);

}  // namespace hedgerow::tool
