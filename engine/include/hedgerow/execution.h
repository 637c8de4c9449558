#pragma once

#include <cstdint>

#include "hedgerow/index.h"

namespace hedgerow {

/// A caller's own parallel loop: calls `body(user, begin, end)` for ranges that partition
/// [0, count), each at least `grain` long where possible, from any threads, and returns when all
/// are done.
using ParallelFor = void (*)(void* context, Index count, Index grain,
                             void (*body)(void* user, Index begin, Index end), void* user);

/// Where an operation runs: the caller's threads, never our own.
///
/// Results are the same bits for every execution, thread count and grain.
/// Threads   Copyable value; one `Execution` may be used from several threads at once.
/// Lifetime  A named arena or a callback's context must outlive the calls it is used for.
class Execution {
 public:
  enum class Kind : std::uint8_t { serial, current_arena, named_arena, callback };

  /// Everything on the calling thread.
  [[nodiscard]] static constexpr Execution serial() noexcept { return {}; }

  /// The TBB arena that the calling thread is in, with as many threads as that arena has.
  [[nodiscard]] static Execution current_arena() noexcept;

  /// A `tbb::task_arena` of the caller's, whose threads are counted now. A template, so that this
  /// header needs no TBB.
  template <class Arena>
  [[nodiscard]] static Execution in(Arena& arena) {
    Execution execution;
    execution.kind_ = Kind::named_arena;
    execution.threads_ = arena.max_concurrency();
    execution.context_ = &arena;
    execution.enter_ = [](void* context, void (*function)(void*), void* user) {
      static_cast<Arena*>(context)->execute([=] { function(user); });
    };
    return execution;
  }

  /// A parallel loop of the caller's, with `threads` workers (at least 1). \pre `loop` is not null,
  /// and calls the body with ranges that partition [0, count), each once, before it returns.
  [[nodiscard]] static Execution callback(ParallelFor loop, void* context, int threads) noexcept;

  /// The same execution with another task size in elements; 0 leaves the choice to each operation.
  /// \pre grain >= 0
  [[nodiscard]] constexpr Execution with_grain(Index grain) const noexcept {
    Execution execution = *this;
    execution.grain_ = grain;
    return execution;
  }

  [[nodiscard]] constexpr Kind kind() const noexcept { return kind_; }
  [[nodiscard]] constexpr int threads() const noexcept { return threads_; }
  [[nodiscard]] constexpr Index grain() const noexcept { return grain_; }

  // For the parallel layer.
  using Enter = void (*)(void* context, void (*function)(void*), void* user);
  [[nodiscard]] constexpr Enter enter() const noexcept { return enter_; }
  [[nodiscard]] constexpr ParallelFor loop() const noexcept { return loop_; }
  [[nodiscard]] constexpr void* context() const noexcept { return context_; }

 private:
  Kind kind_ = Kind::serial;
  int threads_ = 1;
  Index grain_ = 0;
  void* context_ = nullptr;
  Enter enter_ = nullptr;
  ParallelFor loop_ = nullptr;
};

}  // namespace hedgerow
