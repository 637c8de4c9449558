#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <memory>
#include <utility>

#include "hedgerow/execution.h"
#include "hedgerow/index.h"

/// The only interface between the engine and threads. parallel.cpp alone includes TBB.
namespace hedgerow::par {

namespace detail {
/// Calls body(user, begin, end) over ranges that partition [0, count).
void run(const Execution& execution, Index count, Index grain,
         void (*body)(void* user, Index begin, Index end), void* user);
}  // namespace detail

/// The calling thread by itself, for a library that would take every thread of the TBB arena that
/// it is called in. Made once and kept: entering it allocates nothing.
class LoneThread {
 public:
  LoneThread();
  LoneThread(LoneThread&&) noexcept;
  LoneThread& operator=(LoneThread&&) noexcept;
  ~LoneThread();

  /// Calls `function(user)` on the calling thread, in an arena where no other thread works.
  void enter(void (*function)(void*), void* user);

 private:
  struct Arena;
  std::unique_ptr<Arena> arena_;
};

/// Calls `function()` once, where TBB tasks that it starts run on the threads of `execution`: in
/// its arena, or for serial and callback executions in that of `lone`.
template <class Function>
void call_inside(const Execution& execution, LoneThread& lone, const Function& function) {
  const auto call = [](void* user) { (*static_cast<const Function*>(user))(); };
  void* user = const_cast<Function*>(&function);
  switch (execution.kind()) {
    case Execution::Kind::named_arena:
      execution.enter()(execution.context(), call, user);
      return;
    case Execution::Kind::current_arena:
      call(user);
      return;
    default:
      lone.enter(call, user);
  }
}

/// Task size: the caller's if it asked for one, else the operation's own.
[[nodiscard]] inline Index grain_of(const Execution& execution, Index own) noexcept {
  return execution.grain() > 0 ? execution.grain() : own;
}

/// Calls `kernel(IndexRange)` over ranges that partition [0, count). `kernel` must be a pure
/// function of its range that writes elements no other range writes.
template <class Kernel>
void for_each_range(const Execution& execution, Index count, Index grain, const Kernel& kernel) {
  if (count <= 0) return;
  detail::run(
      execution, count, grain_of(execution, grain),
      [](void* user, Index begin, Index end) {
        (*static_cast<const Kernel*>(user))(IndexRange{begin, end});
      },
      const_cast<Kernel*>(&kernel));
}

/// How many tasks `for_each_task` runs at once at the most, so how many scratch slots it needs.
[[nodiscard]] inline Index slot_count(const Execution& execution, Index task_count) noexcept {
  const auto threads = static_cast<Index>(execution.threads());
  return task_count < threads ? task_count : threads;
}

/// Calls `function(task, slot)` for every task in [0, count), handing tasks out in ascending order;
/// calls with the same slot never overlap, so slot s may own scratch memory.
template <class Function>
void for_each_task(const Execution& execution, Index count, const Function& function) {
  std::atomic<Index> next{0};
  for_each_range(execution.with_grain(1), slot_count(execution, count), 1, [&](IndexRange slots) {
    for (Index slot = slots.begin; slot < slots.end; ++slot) {
      for (Index task = next.fetch_add(1); task < count; task = next.fetch_add(1)) {
        function(task, slot);
      }
    }
  });
}

/// Part number `part` of `part_count` about equal ones that [0, count) is cut into.
[[nodiscard]] inline IndexRange share_of(Index part, Index part_count, Index count) noexcept {
  const auto bound = [&](Index i) {
    return static_cast<Index>(std::int64_t{count} * i / part_count);
  };
  return {bound(part), bound(part + 1)};
}

/// How many shares of [0, count) are worth an array each: one a thread, each of a grain or more.
[[nodiscard]] inline Index share_count(const Execution& execution, Index count,
                                       Index grain) noexcept {
  const Index wanted = slot_count(execution, count / grain_of(execution, grain));
  return wanted < 1 ? 1 : wanted;
}

/// Folds `kernel(IndexRange) -> T` over [0, count) with `join`, which must be exactly associative
/// and commutative (integer sums, min, max; not float sums) and leave `T{}` out: then the result is
/// the same for every execution.
template <class T, class Kernel, class Join>
[[nodiscard]] T reduce(const Execution& execution, Index count, Index grain, const Kernel& kernel,
                       const Join& join) {
  const Index size = grain_of(execution, grain);
  const Index block_count = count > 0 ? (count - 1) / size + 1 : 0;
  if (block_count <= 1 || execution.threads() == 1) {
    return count > 0 ? kernel(IndexRange{0, count}) : T{};
  }
  std::atomic_flag lock = ATOMIC_FLAG_INIT;
  T total{};
  for_each_range(execution, count, grain, [&](IndexRange range) {
    const T part = kernel(range);
    while (lock.test_and_set(std::memory_order_acquire)) {
    }
    total = join(total, part);
    lock.clear(std::memory_order_release);
  });
  return total;
}

/// Folds `function(task, slot) -> T` over the tasks [0, count) with `join`, as `for_each_task` and
/// `reduce` do.
template <class T, class Function, class Join>
[[nodiscard]] T reduce_tasks(const Execution& execution, Index count, const Function& function,
                             const Join& join) {
  std::atomic_flag lock = ATOMIC_FLAG_INIT;
  T total{};
  for_each_task(execution, count, [&](Index task, Index slot) {
    const T part = function(task, slot);
    while (lock.test_and_set(std::memory_order_acquire)) {
    }
    total = join(total, part);
    lock.clear(std::memory_order_release);
  });
  return total;
}

}  // namespace hedgerow::par
