#include "parallel/parallel.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace hedgerow {

Execution Execution::current_arena() noexcept {
  Execution execution;
  execution.kind_ = Kind::current_arena;
  execution.threads_ = tbb::this_task_arena::max_concurrency();
  return execution;
}

Execution Execution::callback(ParallelFor loop, void* context, int threads) noexcept {
  Execution execution;
  execution.kind_ = Kind::callback;
  execution.threads_ = threads < 1 ? 1 : threads;
  execution.context_ = context;
  execution.loop_ = loop;
  return execution;
}

namespace par {

struct LoneThread::Arena {
  tbb::task_arena arena{1};
};
LoneThread::LoneThread() : arena_(std::make_unique<Arena>()) {}
LoneThread::LoneThread(LoneThread&&) noexcept = default;
LoneThread& LoneThread::operator=(LoneThread&&) noexcept = default;
LoneThread::~LoneThread() = default;
void LoneThread::enter(void (*function)(void*), void* user) {
  arena_->arena.execute([=] { function(user); });
}

namespace detail {
namespace {

struct Loop {
  Index count;
  Index grain;
  void (*body)(void* user, Index begin, Index end);
  void* user;
};

// simple_partitioner keeps to the grain: with the automatic one, a loop over a few heavy tasks may
// hand all of them to one thread.
void run_in_arena(const Loop& loop) {
  tbb::parallel_for(
      tbb::blocked_range<Index>(0, loop.count, static_cast<std::size_t>(loop.grain)),
      [&](const tbb::blocked_range<Index>& r) { loop.body(loop.user, r.begin(), r.end()); },
      tbb::simple_partitioner());
}

}  // namespace

void run(const Execution& execution, Index count, Index grain,
         void (*body)(void* user, Index begin, Index end), void* user) {
  if (grain < 1) grain = 1;
  if (execution.kind() == Execution::Kind::serial || count <= grain) {
    body(user, 0, count);
    return;
  }
  Loop loop{count, grain, body, user};
  switch (execution.kind()) {
    case Execution::Kind::named_arena:
      execution.enter()(
          execution.context(), [](void* l) { run_in_arena(*static_cast<Loop*>(l)); }, &loop);
      return;
    case Execution::Kind::callback:
      execution.loop()(execution.context(), count, grain, body, user);
      return;
    default:
      run_in_arena(loop);
  }
}

}  // namespace detail
}  // namespace par
}  // namespace hedgerow
