#pragma once

#include <atomic>

#include <tbb/task_scheduler_observer.h>

namespace hedgerow::test {

/// How often TBB has lent a thread to any arena of the process, since the first call.
///
/// The observer stays for good: TBB never frees what it keeps of one that ends its observation.
inline int worker_entries() {
  class Observer : public tbb::task_scheduler_observer {
   public:
    Observer() { observe(true); }
    void on_scheduler_entry(bool is_worker) override {
      if (is_worker) ++workers;
    }
    std::atomic<int> workers = 0;
  };
  static auto* const observer = new Observer;
  return observer->workers;
}

}  // namespace hedgerow::test
