#include "rounds.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <memory>
#include <regex>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

#include "baselines/bandwidth.h"
#include "peers/measured_mesh.h"
#include "results.h"
#include "runner.h"

namespace hedgerow::bench {

namespace {

using baselines::StreamArrays;
using baselines::StreamKernel;
using Clock = std::chrono::steady_clock;

constexpr double kBatchSeconds = 2e-3;
constexpr int kMaxBatch = 2000;
constexpr std::size_t kMinRounds = 2;
// A row that is measured in less than a batch is over in the time of a hiccup: more rounds of it
// cost little.
constexpr int kQuickFactor = 5;
/// A virtual machine may report the last-level cache of its whole host, so there is a limit.
constexpr std::size_t kBandwidthBytes = std::size_t{1536} << 20U;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

int batch_size(double seconds) {
  return static_cast<int>(std::clamp(std::ceil(kBatchSeconds / seconds), 1.0, double{kMaxBatch}));
}

/// The kernels of a mix: plain stores, and streaming ones where it writes.
std::vector<StreamKernel> kernels_of(Mix mix) {
  if (mix == Mix::read) return {StreamKernel::read};
  if (mix == Mix::copy) return {StreamKernel::copy, StreamKernel::copy_streaming};
  return {StreamKernel::triad, StreamKernel::triad_streaming};
}

/// Mean seconds of a pass of `kernel`, over a batch.
double stream_seconds(StreamArrays& arrays, StreamKernel kernel, int threads) {
  const double first = arrays.run(kernel, threads);
  const int count = batch_size(first) - 1;
  if (count == 0) return first;
  double sum = 0;
  for (int i = 0; i < count; ++i) sum += arrays.run(kernel, threads);
  return sum / count;
}

/// The bandwidth kernels of one mix on one number of bytes and threads.
struct Limit {
  Mix mix = Mix::triad;
  double bytes = 0;
  int threads = 1;
  std::shared_ptr<StreamArrays> arrays;  // shared by the numbers of threads
  std::vector<Bandwidth> kernels;

  void measure() {
    for (Bandwidth& kernel : kernels) {
      const double moved =
          static_cast<double>(arrays->array_bytes()) * baselines::arrays_touched(kernel.kernel);
      kernel.gb_per_s.push_back(moved / stream_seconds(*arrays, kernel.kernel, threads) * 1e-9);
    }
  }
};

/// Seconds of one run.
double timed_run(const Work& work) {
  if (work.setup) work.setup();
  const Clock::time_point start = Clock::now();
  work.run();
  const double seconds = seconds_since(start);
  if (work.cleanup) work.cleanup();
  return seconds;
}

/// One case, ready to be timed.
struct Contender {
  const Case* benchmark = nullptr;
  Work work;
  Row row;
  double spent_seconds = 0;
  int batch = 1;

  [[nodiscard]] bool is_due(int round, const RoundsOptions& options) const noexcept {
    if (round >= options.rounds) return batch > 1;
    return row.times_ns.size() < kMinRounds || spent_seconds <= options.budget_seconds;
  }

  void measure() {
    // Rows of one thread may have left the others asleep for a second, and a virtual machine's
    // processor takes milliseconds to come back: longer than the row.
    if (benchmark->threads > 1) (void)timed_run(work);
    double seconds = 0;
    double processor_seconds = 0;
    for (int i = 0; i < batch; ++i) {
      if (work.setup) work.setup();
      const double processor_start = processor_time();
      const Clock::time_point start = Clock::now();
      work.run();
      seconds += seconds_since(start);
      processor_seconds += processor_time() - processor_start;
      if (work.cleanup) work.cleanup();
    }
    spent_seconds += seconds;
    row.times_ns.push_back(seconds / batch * 1e9);
    row.processor_ns.push_back(processor_seconds / batch * 1e9);
  }
};

class Group {
 public:
  explicit Group(const std::vector<const Case*>& cases) {
    for (const Case* benchmark : cases) add(*benchmark);
  }

  void run(const RoundsOptions& options) {
    for (Contender& contender : contenders_) warm_up(contender);
    const int most = options.is_smoke ? options.rounds : kQuickFactor * options.rounds;
    for (int round = 0; round < most; ++round) {
      const auto is_due = [&](const Contender& contender) {
        return contender.row.error.empty() && contender.is_due(round, options);
      };
      if (std::ranges::none_of(contenders_, is_due)) break;
      for (Limit& limit : limits_) limit.measure();
      for (Contender& contender : contenders_) {
        if (is_due(contender)) contender.measure();
      }
    }
  }

  [[nodiscard]] std::vector<Row> take_rows() {
    std::vector<Row> rows;
    for (Contender& contender : contenders_) {
      if (contender.row.traffic.total() > 0) {
        contender.row.bandwidths = limit_of(contender).kernels;
      }
      rows.push_back(std::move(contender.row));
    }
    return rows;
  }

 private:
  void add(const Case& benchmark) {
    Contender contender;
    contender.benchmark = &benchmark;
    const Dataset& data = dataset(benchmark.data);
    contender.work = benchmark.prepare(data, execution_with(benchmark.threads));
    const Answer answer = first_answer(contender.work, true);
    Row& row = contender.row;
    row.name = benchmark.name();
    row.error = answer.error;
    row.counts = counts_of(data);
    row.mesh_bytes = static_cast<double>(data.mesh.bytes());
    row.traffic = benchmark.traffic(data);
    row.mix = benchmark.mix;
    row.notes = answer.notes;
    // Where no bytes are stated, as for questions to records, there is no limit to compare with.
    if (row.traffic.total() > 0) add_limit(benchmark, row.traffic.total());
    contenders_.push_back(std::move(contender));
  }

  void add_limit(const Case& benchmark, double bytes) {
    std::shared_ptr<StreamArrays> arrays;
    for (const Limit& limit : limits_) {
      if (limit.mix != benchmark.mix || limit.bytes != bytes) continue;
      if (limit.threads == benchmark.threads) return;
      arrays = limit.arrays;
    }
    const std::vector<StreamKernel> kernels = kernels_of(benchmark.mix);
    if (!arrays) {
      const double touched = baselines::arrays_touched(kernels.front());
      arrays = std::make_shared<StreamArrays>(static_cast<std::size_t>(bytes / touched));
    }
    Limit limit{benchmark.mix, bytes, benchmark.threads, std::move(arrays), {}};
    for (const StreamKernel kernel : kernels) limit.kernels.push_back({kernel, {}});
    limits_.push_back(std::move(limit));
  }

  [[nodiscard]] const Limit& limit_of(const Contender& contender) const {
    return *std::ranges::find_if(limits_, [&](const Limit& limit) {
      return limit.mix == contender.row.mix && limit.bytes == contender.row.traffic.total() &&
             limit.threads == contender.benchmark->threads;
    });
  }

  // The checked run was the first; a fast case is timed twice more to know how often to repeat it,
  // as one time may have met a hiccup.
  static void warm_up(Contender& contender) {
    if (!contender.row.error.empty()) return;
    double seconds = timed_run(contender.work);
    if (seconds < 10 * kBatchSeconds) seconds = std::min(seconds, timed_run(contender.work));
    contender.batch = batch_size(seconds);
  }

  std::vector<Contender> contenders_;
  std::vector<Limit> limits_;
};

struct NamedGroup {
  std::string name;
  std::vector<const Case*> cases;
};

/// Which dataset a group is on, with those that it is compared with: "/grid/4M".
std::string data_name(const NamedGroup& group) { return group.name.substr(group.name.find('/')); }

/// Groups of the cases that pass the filter; those of one dataset follow each other.
std::vector<NamedGroup> chosen_groups(const std::string& filter) {
  const std::regex pattern(filter);
  std::vector<NamedGroup> groups;
  for (const Case& benchmark : all_cases()) {
    if (!std::regex_search(benchmark.name(), pattern)) continue;
    const std::string group_name = benchmark.group();
    auto found = std::ranges::find(groups, group_name, &NamedGroup::name);
    if (found == groups.end()) found = groups.insert(groups.end(), {group_name, {}});
    found->cases.push_back(&benchmark);
  }
  std::vector<std::string> order;
  for (const NamedGroup& group : groups) {
    if (std::ranges::find(order, data_name(group)) == order.end())
      order.push_back(data_name(group));
  }
  std::ranges::stable_sort(groups, {}, [&](const NamedGroup& group) {
    return std::ranges::find(order, data_name(group)) - order.begin();
  });
  return groups;
}

/// What the memory does on arrays that no cache holds.
std::vector<Row> bandwidth_rows(const RoundsOptions& options, const std::set<int>& threads) {
  const std::size_t array_bytes =
      options.is_smoke ? std::size_t{1} << 16U : baselines::stream_array_bytes(kBandwidthBytes);
  const auto arrays = std::make_shared<StreamArrays>(array_bytes);
  std::vector<Limit> limits;
  for (const Mix mix : {Mix::read, Mix::copy, Mix::triad}) {
    for (const int count : threads) {
      Limit limit{mix, 0, count, arrays, {}};
      for (const StreamKernel kernel : kernels_of(mix)) limit.kernels.push_back({kernel, {}});
      limits.push_back(std::move(limit));
    }
  }
  for (int round = 0; round < options.rounds; ++round) {
    for (Limit& limit : limits) limit.measure();
  }
  std::vector<Row> rows;
  for (const Limit& limit : limits) {
    Row row;
    row.name = std::string("bandwidth/") + name(limit.mix) + "/" +
               std::to_string(3 * arrays->array_bytes() >> 20U) + "MiB/" +
               std::to_string(limit.threads);
    row.mix = limit.mix;
    row.bandwidths = limit.kernels;
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace

int run_rounds(const RoundsOptions& options) {
  std::vector<Row> rows;
  std::set<int> threads;
  int error_count = 0;
  std::string last_data;
  const Clock::time_point begin = Clock::now();
  for (const NamedGroup& group : chosen_groups(options.filter)) {
    const Clock::time_point start = Clock::now();
    if (data_name(group) != last_data) forget_built_meshes();
    last_data = data_name(group);
    forget_other_datasets(group.cases.front()->data);
    for (const Case* benchmark : group.cases) threads.insert(benchmark->threads);
    Group measured(group.cases);
    measured.run(options);
    for (Row& row : measured.take_rows()) {
      if (!row.error.empty()) std::cerr << row.name << ": " << row.error << "\n";
      if (!row.error.empty()) ++error_count;
      rows.push_back(std::move(row));
    }
    std::cerr << std::fixed << std::setprecision(1) << std::setw(7) << seconds_since(begin)
              << " s  " << group.name << ": " << group.cases.size() << " rows in "
              << seconds_since(start) << " s\n";
  }
  std::vector<Row> all = bandwidth_rows(options, threads);
  std::ranges::move(rows, std::back_inserter(all));
  write_results(options.out, all, options.rounds);
  return error_count;
}

}  // namespace hedgerow::bench
