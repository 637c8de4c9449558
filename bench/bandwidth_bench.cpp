// What the memory of this machine does, in the same process as everything else: the rate that each
// row of PERF.md is a share of.
#include <map>
#include <memory>

#include <benchmark/benchmark.h>

#include "baselines/bandwidth.h"
#include "google.h"
#include "runner.h"

namespace hedgerow::bench {

namespace {

using baselines::StreamArrays;
using baselines::StreamKernel;

/// A virtual machine may report the last-level cache of its whole host, so there is a limit.
constexpr std::size_t kLimitBytes = std::size_t{1536} << 20U;

void measure(benchmark::State& state, StreamKernel kernel, std::size_t array_bytes, int threads) {
  StreamArrays arrays(array_bytes);
  arrays.run(kernel, threads);
  if (!arrays.is_correct()) {
    state.SkipWithError("wrong values; not measured");
    return;
  }
  for (auto _ : state) state.SetIterationTime(arrays.run(kernel, threads));
  const auto bytes = static_cast<double>(arrays.array_bytes()) * arrays_touched(kernel);
  state.SetBytesProcessed(
      static_cast<std::int64_t>(static_cast<double>(state.iterations()) * bytes));
  state.counters["bytes"] = bytes;
}

}  // namespace

void add_bandwidth(const Plan& plan) {
  const std::size_t array_bytes =
      plan.is_smoke ? std::size_t{1} << 16U : baselines::stream_array_bytes(kLimitBytes);
  const std::string size = std::to_string(3 * array_bytes >> 10U) + "KiB";
  for (const StreamKernel kernel :
       {StreamKernel::read, StreamKernel::copy, StreamKernel::copy_streaming, StreamKernel::triad,
        StreamKernel::triad_streaming}) {
    for (const int threads : plan.threads) {
      const std::string name = std::string("bandwidth/") + baselines::name(kernel) + "/" + size +
                               "/" + std::to_string(threads);
      add_extra(name,
                [=](benchmark::State& state) { measure(state, kernel, array_bytes, threads); });
    }
  }
}

}  // namespace hedgerow::bench
