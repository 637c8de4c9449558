#pragma once

#include <string>
#include <vector>

#include "exit_status.h"
#include "hedgerow/result.h"

namespace hedgerow::tool {

/// Why a command ends without a result. Thrown by the commands, printed once by `main`.
struct Failure {
  ExitStatus status = ExitStatus::usage;
  std::string where;  ///< "PATH:LINE:COLUMN", "PATH@BYTE", "PATH" or "hedgerow"
  std::string code;   ///< stable lower-case word with dashes
  std::string message;
  std::vector<std::string> details;  ///< printed indented, one line each
};

/// "WHERE: error: CODE: MESSAGE" and the details, each line ended; "error:" red if `colour`.
[[nodiscard]] std::string text(const Failure& failure, bool colour);

/// The failure that an engine error amounts to, in words that name the values.
/// `where` is the path of the mesh it is about.
[[nodiscard]] Failure describe(const Error& error, const std::string& where);

}  // namespace hedgerow::tool
