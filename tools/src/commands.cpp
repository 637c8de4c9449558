#include "commands.h"

namespace hedgerow::tool {

void add_commands(Program& program) {
  add_inspect(program);
  add_report(program);
  add_normals(program);
  add_convert(program);
  add_generate(program);
  add_reorder(program);
  add_repair(program);
}

}  // namespace hedgerow::tool
