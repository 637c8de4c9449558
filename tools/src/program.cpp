#include "program.h"

#include <cstdio>
#include <exception>
#include <new>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "build_info.h"
#include "failure.h"
#include "terminal.h"

namespace hedgerow::tool {
namespace {

constexpr const char* kName = "hedgerow";

ExitStatus report(const Failure& failure) {
  std::fputs(text(failure, wants_colour(stderr)).c_str(), stderr);
  return failure.status;
}

}  // namespace

Program::Program()
    : app_(std::make_unique<CLI::App>(
          "Half-edge mesh connectivity: inspect, repair, convert, measure", kName)) {
  app_->set_version_flag("--version", version_text());
  app_->require_subcommand(1);
  app_->get_formatter()->column_width(34);
  app_->get_formatter()->label("SUBCOMMAND", "COMMAND");
  app_->footer(
      "Reads .obj .ply .off .stl .gltf .glb .wet; writes .obj .ply .off .stl .wet.\n"
      "Exit status: 0 done; 1 defects under --strict, or a check failed; 2 usage; 3 bad input;\n"
      "4 output cannot be written; 5 out of memory or too many elements.\n\n"
      "Example: hedgerow inspect bunny.ply\n"
      "Help on a command: hedgerow COMMAND --help");
}

Program::~Program() = default;

Command Program::add_command(const std::string& name, const std::string& summary,
                             const std::string& details, const std::string& example, Body body) {
  CLI::App* command = app_->add_subcommand(name, summary);
  command->group("Commands");
  command->footer((details.empty() ? "" : details + "\n\n") + "Example: " + example);
  add_options(*command, options_);
  commands_.emplace_back(command, std::move(body));
  return Command(*command);
}

std::string Program::unknown_command(const std::vector<std::string>& arguments) const {
  if (arguments.empty() || arguments.front().starts_with('-')) return {};
  for (const auto& [command, body] : commands_) {
    if (command->get_name() == arguments.front()) return {};
  }
  return arguments.front();
}

Failure Program::usage_failure(const CLI::ParseError& error) const {
  const auto parsed = app_->get_subcommands();
  if (!parsed.empty()) {
    return {ExitStatus::usage,
            kName,
            "usage",
            error.what(),
            {fmt::format("see {} {} --help", kName, parsed.front()->get_name())}};
  }
  const bool is_bare = dynamic_cast<const CLI::RequiredError*>(&error) != nullptr;
  return {ExitStatus::usage,
          kName,
          "usage",
          is_bare ? "no command was given" : error.what(),
          {"hedgerow --help lists the commands"}};
}

ExitStatus Program::run_command(const std::vector<std::string>& arguments) {
  if (const std::string word = unknown_command(arguments); !word.empty()) {
    throw Failure{ExitStatus::usage,
                  kName,
                  "usage",
                  fmt::format("there is no command \"{}\"", word),
                  {"hedgerow --help lists the commands"}};
  }
  try {
    app_->parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) {  // --help or --version
      app_->exit(error);
      return ExitStatus::done;
    }
    throw usage_failure(error);
  }
  for (const auto& [command, body] : commands_) {
    if (!command->parsed()) continue;
    Run run(options_);
    return body(run);
  }
  return ExitStatus::usage;
}

ExitStatus Program::run(int argument_count, const char* const* arguments) {
  try {
    return run_command({arguments + 1, arguments + argument_count});
  } catch (const Failure& failure) {
    return report(failure);
  } catch (const std::bad_alloc&) {
    return report({ExitStatus::limit,
                   kName,
                   "out-of-memory",
                   "there is not enough memory for this mesh",
                   {}});
  } catch (const std::exception& error) {
    return report({ExitStatus::limit, kName, "internal", error.what(), {}});
  }
}

}  // namespace hedgerow::tool
