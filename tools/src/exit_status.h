#pragma once

namespace hedgerow::tool {

/// What the program returns to the shell.
enum class ExitStatus : int {
  done = 0,
  defects = 1,  ///< --strict and the mesh has defects, or a check failed
  usage = 2,
  input = 3,   ///< the input cannot be read or is malformed
  output = 4,  ///< the output cannot be written
  limit = 5,   ///< out of memory, or more elements than an index can count
};

}  // namespace hedgerow::tool
