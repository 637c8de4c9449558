#pragma once

#include "program.h"

namespace hedgerow::tool {

/// All commands, in the order of the help.
void add_commands(Program& program);

}  // namespace hedgerow::tool
