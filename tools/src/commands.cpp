#include "commands.h"

namespace hedgerow::tool {

void add_commands(Program& program) {
  add_inspect(program);
  add_report(program);
  add_normals(program);
#if HEDGEROW_HAS_RAY
  add_render(program);
#endif
  add_convert(program);
  add_generate(program);
  add_reorder(program);
  add_repair(program);
  add_subdivide(program);
  add_decimate(program);
  add_smooth(program);
  add_delaunay(program);
  add_voronoi(program);
}

}  // namespace hedgerow::tool
