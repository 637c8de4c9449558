#pragma once

#include "program.h"

namespace hedgerow::tool {

void add_convert(Program& program);
void add_decimate(Program& program);
void add_delaunay(Program& program);
void add_generate(Program& program);
void add_inspect(Program& program);
void add_normals(Program& program);
void add_render(Program& program);  ///< defined only with HEDGEROW_HAS_RAY
void add_reorder(Program& program);
void add_repair(Program& program);
void add_report(Program& program);
void add_voronoi(Program& program);
void add_smooth(Program& program);
void add_subdivide(Program& program);

/// All commands, in the order of the help.
void add_commands(Program& program);

}  // namespace hedgerow::tool
