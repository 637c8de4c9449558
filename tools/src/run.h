#pragma once

#include <memory>
#include <string_view>

#include <nlohmann/json.hpp>

#include "hedgerow/execution.h"
#include "options.h"
#include "progress.h"

namespace hedgerow::tool {

/// Fields keep the order in which they are set.
using Json = nlohmann::ordered_json;

/// What a command runs with: its options, its threads, and the ways out.
///
/// Lifetime   `execution()` is valid as long as the run.
class Run {
 public:
  explicit Run(const Options& options);
  ~Run();
  Run(const Run&) = delete;
  Run& operator=(const Run&) = delete;

  [[nodiscard]] const Options& options() const noexcept { return options_; }
  [[nodiscard]] int threads() const noexcept { return threads_; }
  /// As many threads as --threads says.
  [[nodiscard]] Execution execution() const;
  /// Calls `function` inside the arena of those threads.
  template <class Function>
  void in_arena(const Function& function) {
    in_arena([](const void* user) { (*static_cast<const Function*>(user))(); }, &function);
  }
  [[nodiscard]] Progress& progress() noexcept { return progress_; }

  /// True if text for people is wanted on standard output.
  [[nodiscard]] bool is_text() const noexcept { return !options_.json; }
  [[nodiscard]] bool colour() const noexcept { return colour_; }
  /// Standard output. Throws `Failure` if it cannot be written.
  void print(std::string_view text);
  void print_json(const Json& object);
  /// Standard error; silent under --quiet.
  void note(std::string_view text);

 private:
  struct Threads;
  void in_arena(void (*function)(const void*), const void* user);

  Options options_;
  int threads_;
  bool colour_;
  std::unique_ptr<Threads> arena_;
  Progress progress_;
};

/// The object as it is printed and written: indented by two, bytes that are not UTF-8 replaced.
[[nodiscard]] std::string json_text(const Json& object);

}  // namespace hedgerow::tool
