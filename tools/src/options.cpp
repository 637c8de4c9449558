#include "options.h"

#include <optional>
#include <string>
#include <string_view>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace hedgerow::tool {
namespace {

constexpr std::string_view kNonFinite = "non-finite";

/// The default first.
std::string supported_actions(DefectKind kind) {
  std::string words = name(Policies{}[kind]);
  for (const Action action :
       {Action::fail, Action::skip, Action::cut, Action::split, Action::keep}) {
    if (!is_supported(kind, action) || action == Policies{}[kind]) continue;
    words += fmt::format(", {}", name(action));
  }
  return words;
}

/// One line for each kind.
std::string policy_table() {
  std::string lines;
  for (std::size_t i = 0; i < kDefectKindCount; ++i) {
    const auto kind = static_cast<DefectKind>(i);
    lines += fmt::format("  {:<18} {}\n", name(kind), supported_actions(kind));
  }
  return lines + fmt::format("  {:<18} {}", kNonFinite, "fail, keep");
}

std::string known_kinds() {
  std::string words;
  for (std::size_t i = 0; i < kDefectKindCount; ++i) {
    words += fmt::format("{}, ", name(static_cast<DefectKind>(i)));
  }
  return words + std::string(kNonFinite);
}

void set_policy(const std::string& text, Options& options) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos) {
    throw CLI::ValidationError("--policy", fmt::format("\"{}\" is not KIND=ACTION", text));
  }
  const std::string_view kind_word = std::string_view(text).substr(0, equals);
  const std::string_view action_word = std::string_view(text).substr(equals + 1);
  if (kind_word == kNonFinite) {
    if (action_word != "keep" && action_word != "fail") {
      throw CLI::ValidationError(
          "--policy", fmt::format("non-finite takes fail or keep, not \"{}\"", action_word));
    }
    options.keep_non_finite = action_word == "keep";
    return;
  }
  const std::optional<DefectKind> kind = defect_kind_named(kind_word);
  if (!kind) {
    throw CLI::ValidationError(
        "--policy", fmt::format("unknown kind \"{}\"; kinds are {}", kind_word, known_kinds()));
  }
  const std::optional<Action> action = action_named(action_word);
  if (!action || !is_supported(*kind, *action)) {
    throw CLI::ValidationError("--policy", fmt::format("{} takes {}, not \"{}\"", name(*kind),
                                                       supported_actions(*kind), action_word));
  }
  options.policies[*kind] = *action;
  options.is_policy_given[static_cast<std::size_t>(*kind)] = true;
}

}  // namespace

void add_options(CLI::App& app, Options& options) {
  const std::string group = "Options of every command";
  app.add_flag("--json", options.json, "Print one JSON object on standard output, nothing else")
      ->group(group);
  app.add_option("--threads", options.threads, "Threads to use; default: one per processor")
      ->type_name("N")
      ->check(CLI::Range(1, kMaxThreads))
      ->group(group);
  app.add_option_function<std::vector<std::string>>(
         "--policy",
         [&options](const std::vector<std::string>& texts) {
           for (const std::string& text : texts) set_policy(text, options);
         },
         "What to do about a kind of defect; may be repeated.\nActions of each kind, the default "
         "first:\n" +
             policy_table())
      ->type_name("KIND=ACTION")
      ->allow_extra_args(false)
      ->group(group);
  app.add_flag("--strict", options.strict,
               "Exit with 1 if the mesh has defects; nothing is written then")
      ->group(group);
  app.add_flag("--quiet", options.quiet, "Print results and errors only")->group(group);
  app.add_flag("--no-progress", options.no_progress, "Draw no progress bar")->group(group);
}

}  // namespace hedgerow::tool
