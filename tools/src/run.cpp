#include "run.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <optional>

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/task_arena.h>

#include "failure.h"
#include "terminal.h"

namespace hedgerow::tool {

struct Run::Threads {
  explicit Threads(int count) : arena(count) {
    // TBB caps its workers at the number of processors unless it is told otherwise.
    if (count > tbb::info::default_concurrency()) {
      more_workers.emplace(tbb::global_control::max_allowed_parallelism,
                           static_cast<std::size_t>(count));
    }
  }
  std::optional<tbb::global_control> more_workers;
  tbb::task_arena arena;
};

Run::Run(const Options& options)
    : options_(options),
      threads_(options.threads > 0 ? options.threads : tbb::info::default_concurrency()),
      colour_(wants_colour(stdout)),
      arena_(std::make_unique<Threads>(threads_)),
      progress_(is_terminal(stderr) && !options.quiet && !options.no_progress) {}

Run::~Run() = default;

Execution Run::execution() const {
  return threads_ == 1 ? Execution::serial() : Execution::in(arena_->arena);
}

void Run::in_arena(void (*function)(const void*), const void* user) {
  arena_->arena.execute([=] { function(user); });
}

void Run::print(std::string_view text) {
  progress_.finish();
  const bool is_written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
  if (!is_written || std::fflush(stdout) != 0) {
    throw Failure{ExitStatus::output, "standard output", "write-failed", std::strerror(errno), {}};
  }
}

void Run::print_json(const Json& object) { print(json_text(object) + '\n'); }

void Run::note(std::string_view text) {
  if (options_.quiet) return;
  progress_.finish();
  std::fwrite(text.data(), 1, text.size(), stderr);
}

std::string json_text(const Json& object) {
  return object.dump(2, ' ', false, Json::error_handler_t::replace);
}

}  // namespace hedgerow::tool
