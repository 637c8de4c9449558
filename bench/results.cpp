#include "results.h"

#include <algorithm>
#include <cstdint>
#include <ctime>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include <benchmark/benchmark.h>
#include <nlohmann/json.hpp>

#include "baselines/instruction_rate.h"
#include "machine.h"

namespace hedgerow::bench {

namespace {

using nlohmann::ordered_json;

/// Five significant digits: more than any clock here is worth.
double rounded(double value) {
  std::ostringstream out;
  out.precision(5);
  out << value;
  return std::stod(out.str());
}
std::int64_t whole(double value) { return static_cast<std::int64_t>(value); }

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

std::string today() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  char text[32] = {};
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%MZ", &parts);
  return text;
}

ordered_json caches_json() {
  ordered_json caches = ordered_json::array();
  for (const auto& cache : benchmark::CPUInfo::Get().caches) {
    caches.push_back({{"level", cache.level},
                      {"type", cache.type},
                      {"bytes", cache.size},
                      {"sharing", std::max(1, cache.num_sharing)}});
  }
  return caches;
}

ordered_json row_json(const Row& row) {
  ordered_json json = {{"name", row.name}};
  if (!row.error.empty()) {
    json["error"] = row.error;
    return json;
  }
  if (!row.times_ns.empty()) {
    for (const double time : row.times_ns) json["times_ns"].push_back(rounded(time));
    json["processor_ns"] = rounded(median(row.processor_ns));
    json["halfedges"] = whole(row.counts.halfedges);
    json["vertices"] = whole(row.counts.vertices);
    json["faces"] = whole(row.counts.faces);
    json["mesh_bytes"] = whole(row.mesh_bytes);
    json["read"] = whole(row.traffic.read);
    json["written"] = whole(row.traffic.written);
  }
  json["mix"] = name(row.mix);
  for (const Bandwidth& kernel : row.bandwidths) {
    json["gb_per_s"][baselines::name(kernel.kernel)] = rounded(median(kernel.gb_per_s));
  }
  for (const auto& [key, value] : row.notes) json[key] = rounded(value);
  return json;
}

}  // namespace

void write_results(const std::string& path, const std::vector<Row>& rows, int rounds) {
  ordered_json context;
  for (const auto& [key, value] : machine_context()) context[key] = value;
  context["instructions_per_ns"] = rounded(baselines::instructions_per_ns());
  context["caches"] = caches_json();
  context["rounds"] = rounds;
  context["date"] = today();
  std::ofstream out(path);
  out << "{\"context\": " << context.dump(1) << ",\n\"rows\": [\n";
  for (std::size_t i = 0; i < rows.size(); ++i) {
    out << (i == 0 ? "" : ",\n") << row_json(rows[i]).dump();
  }
  out << "\n]}\n";
  out.close();
  if (!out) throw std::runtime_error(path + ": cannot be written");
}

}  // namespace hedgerow::bench
