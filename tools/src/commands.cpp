#include "commands.h"

namespace hedgerow::tool {

void add_commands(Program&) {}

}  // namespace hedgerow::tool
