#include "counting.h"

#include <iostream>
#include <regex>
#include <stdexcept>

#include <nlohmann/json.hpp>
#if __has_include(<valgrind/callgrind.h>)
#include <valgrind/callgrind.h>
#endif

#include "peers/measured_mesh.h"
#include "runner.h"

namespace hedgerow::bench {

namespace {

#if __has_include(<valgrind/callgrind.h>)
void count(const std::string& name, const Work& work) {
  CALLGRIND_START_INSTRUMENTATION;
  work.run();
  CALLGRIND_STOP_INSTRUMENTATION;
  CALLGRIND_DUMP_STATS_AT(name.c_str());
}
#else
void count(const std::string&, const Work&) {
  throw std::runtime_error("built without valgrind's headers, which counting needs");
}
#endif

void print(const Case& benchmark, const Dataset& data) {
  const Counts counts = counts_of(data);
  const nlohmann::ordered_json line = {
      {"name", benchmark.name()},
      {"halfedges", static_cast<std::int64_t>(counts.halfedges)},
      {"vertices", static_cast<std::int64_t>(counts.vertices)},
      {"faces", static_cast<std::int64_t>(counts.faces)},
      {"compulsory_bytes", static_cast<std::int64_t>(benchmark.traffic(data).total())}};
  std::cout << line.dump() << std::endl;  // each line is news: the next one may take a minute
}

}  // namespace

int count_cases(const std::string& filter) {
  const std::regex pattern(filter);
  int error_count = 0;
  for (const Case& benchmark : all_cases()) {
    if (benchmark.threads != 1 || !std::regex_search(benchmark.name(), pattern)) continue;
    forget_other_datasets(benchmark.data);
    const Dataset& data = dataset(benchmark.data);
    const Work work = benchmark.prepare(data, execution_with(benchmark.threads));
    const Answer answer = first_answer(work, true);
    if (!answer.error.empty()) {
      std::cerr << benchmark.name() << ": " << answer.error << "\n";
      ++error_count;
      continue;
    }
    if (work.setup) work.setup();
    count(benchmark.name(), work);
    if (work.cleanup) work.cleanup();
    print(benchmark, data);
  }
  return error_count;
}

}  // namespace hedgerow::bench
