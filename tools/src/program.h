#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "command.h"
#include "exit_status.h"
#include "failure.h"
#include "options.h"
#include "run.h"

namespace CLI {
class ParseError;
}

namespace hedgerow::tool {

/// The command line: which commands there are, what they take and what each one does.
class Program {
 public:
  using Body = std::function<ExitStatus(Run&)>;

  Program();
  ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  /// A new command with the options of every command. `details` and the example are shown at the
  /// end of its help; lines of `details` should fit 100 columns.
  Command add_command(const std::string& name, const std::string& summary,
                      const std::string& details, const std::string& example, Body body);

  /// Parses the arguments and runs the command they name. Throws nothing.
  [[nodiscard]] ExitStatus run(int argument_count, const char* const* arguments);

 private:
  [[nodiscard]] ExitStatus run_command(const std::vector<std::string>& arguments);
  [[nodiscard]] Failure usage_failure(const CLI::ParseError& error) const;
  [[nodiscard]] std::string unknown_command(const std::vector<std::string>& arguments) const;

  std::unique_ptr<CLI::App> app_;
  Options options_;
  std::vector<std::pair<CLI::App*, Body>> commands_;
};

}  // namespace hedgerow::tool
