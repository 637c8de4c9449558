#include "baselines/bandwidth.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <string>
#include <vector>
#if defined(__SSE2__)
#include <emmintrin.h>
#endif

#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>
#include <tbb/task_arena.h>

namespace hedgerow::baselines {

namespace {

constexpr std::size_t kPage = 4096;
constexpr double kScale = 3.0;
constexpr double kValueB = 1.0;
constexpr double kValueC = 2.0;

/// Eight running sums: one would wait for its own addition instead of for memory.
double sum(const double* values, std::size_t count) noexcept {
  double partial[8] = {};
  for (std::size_t i = 0; i < count; i += 8) {
    for (std::size_t j = 0; j < 8; ++j) partial[j] += values[i + j];
  }
  double total = 0;
  for (const double part : partial) total += part;
  return total;
}

void stream_store(double* out, double first, double second) noexcept {
#if defined(__SSE2__)
  _mm_stream_pd(out, _mm_set_pd(second, first));
#else
  out[0] = first;
  out[1] = second;
#endif
}

/// Makes the streamed lines visible before the pass counts as done.
void stream_fence() noexcept {
#if defined(__SSE2__)
  _mm_sfence();
#endif
}

void copy(double* a, const double* b, std::size_t count) noexcept {
  for (std::size_t i = 0; i < count; ++i) a[i] = b[i];
}
void copy_streaming(double* a, const double* b, std::size_t count) noexcept {
  for (std::size_t i = 0; i < count; i += 2) stream_store(a + i, b[i], b[i + 1]);
  stream_fence();
}
void triad(double* a, const double* b, const double* c, std::size_t count) noexcept {
  for (std::size_t i = 0; i < count; ++i) a[i] = b[i] + kScale * c[i];
}
void triad_streaming(double* a, const double* b, const double* c, std::size_t count) noexcept {
  for (std::size_t i = 0; i < count; i += 2) {
    stream_store(a + i, b[i] + kScale * c[i], b[i + 1] + kScale * c[i + 1]);
  }
  stream_fence();
}

}  // namespace

const char* name(StreamKernel kernel) noexcept {
  switch (kernel) {
    case StreamKernel::read:
      return "read";
    case StreamKernel::copy:
      return "copy";
    case StreamKernel::copy_streaming:
      return "copy-streaming";
    case StreamKernel::triad:
      return "triad";
    case StreamKernel::triad_streaming:
      return "triad-streaming";
  }
  return "";
}

int arrays_touched(StreamKernel kernel) noexcept {
  if (kernel == StreamKernel::read) return 1;
  const bool is_copy = kernel == StreamKernel::copy || kernel == StreamKernel::copy_streaming;
  return is_copy ? 2 : 3;
}

StreamArrays::StreamArrays(std::size_t array_bytes)
    : a_(std::max(kPage, array_bytes / kPage * kPage) / sizeof(double), 0.0),
      b_(a_.size(), kValueB),
      c_(a_.size(), kValueC) {}

double StreamArrays::run(StreamKernel kernel, int threads) {
  last_ = kernel;
  const std::size_t block = kPage / sizeof(double);
  const std::size_t blocks = a_.size() / block;
  const auto parts = static_cast<std::size_t>(threads);
  std::vector<double> sums(parts, 0.0);
  const auto run_part = [&](std::size_t part) {
    const std::size_t begin = blocks * part / parts * block;
    const std::size_t count = blocks * (part + 1) / parts * block - begin;
    double* a = a_.data() + begin;
    const double* b = b_.data() + begin;
    const double* c = c_.data() + begin;
    switch (kernel) {
      case StreamKernel::read:
        sums[part] = sum(b, count);
        break;
      case StreamKernel::copy:
        copy(a, b, count);
        break;
      case StreamKernel::copy_streaming:
        copy_streaming(a, b, count);
        break;
      case StreamKernel::triad:
        triad(a, b, c, count);
        break;
      case StreamKernel::triad_streaming:
        triad_streaming(a, b, c, count);
        break;
    }
  };
  tbb::task_arena arena(threads);
  arena.initialize();
  const auto start = std::chrono::steady_clock::now();
  arena.execute(
      [&] { tbb::parallel_for(std::size_t{0}, parts, run_part, tbb::static_partitioner{}); });
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  sum_ = 0;
  for (const double part : sums) sum_ += part;
  return elapsed.count();
}

bool StreamArrays::is_correct() const noexcept {
  if (last_ == StreamKernel::read) return sum_ == kValueB * static_cast<double>(b_.size());
  const bool is_copy = arrays_touched(last_) == 2;
  const double expected = is_copy ? kValueB : kValueB + kScale * kValueC;
  return std::ranges::all_of(a_.span(), [&](double value) { return value == expected; });
}

std::size_t stream_array_bytes(std::size_t limit_bytes) {
  std::size_t cache_bytes = 0;
  for (int level = 0; level < 8; ++level) {
    std::ifstream file("/sys/devices/system/cpu/cpu0/cache/index" + std::to_string(level) +
                       "/size");
    std::size_t size = 0;
    char unit = 0;
    if (!(file >> size)) break;
    file >> unit;
    const std::size_t scale = unit == 'K' ? 1024 : unit == 'M' ? 1024 * 1024 : 1;
    cache_bytes = std::max(cache_bytes, size * scale);
  }
  // Where the system does not say, 32 MiB is a common last-level cache.
  if (cache_bytes == 0) cache_bytes = std::size_t{32} << 20U;
  return std::min(4 * cache_bytes, limit_bytes) / 3;
}

Bandwidth measure_bandwidth(std::size_t array_bytes, int threads, int passes) {
  StreamArrays arrays(array_bytes);
  const auto best = [&](StreamKernel kernel) {
    double seconds = arrays.run(kernel, threads);
    for (int pass = 1; pass < passes; ++pass) {
      seconds = std::min(seconds, arrays.run(kernel, threads));
    }
    const double bytes = static_cast<double>(arrays.array_bytes()) * arrays_touched(kernel);
    return bytes / seconds * 1e-9;
  };
  Bandwidth result;
  result.read_gb_s = best(StreamKernel::read);
  result.copy_gb_s = std::max(best(StreamKernel::copy), best(StreamKernel::copy_streaming));
  result.triad_gb_s = std::max(best(StreamKernel::triad), best(StreamKernel::triad_streaming));
  result.array_bytes = arrays.array_bytes();
  result.threads = threads;
  return result;
}

}  // namespace hedgerow::baselines
