#pragma once

#include <string>

#include "mesh_file.h"
#include "render/palette.h"
#include "render/renderer.h"

namespace hedgerow::tool {

/// A finished picture, and what it took.
struct Picture {
  std::string png;
  std::vector<LegendEntry> legend;
  Json legend_json;
  double tree_ms = 0;
  double draw_ms = 0;
};

/// Builds the tree on one thread, so that the picture has the same bytes for every thread count,
/// and draws on all. `name` is for messages. Throws `Failure`.
[[nodiscard]] Picture make_picture(Run& run, const std::string& name, const BuildFacts& facts,
                                   const Soup& kept, Shading shading, const RenderOptions& options);

}  // namespace hedgerow::tool
