#include "frames/rows.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <stdexcept>

#include <nlohmann/json.hpp>

namespace hedgerow::bench {

void Rows::add(Row row) {
  std::printf("%-3s %-34s %-30s %12.4g %-10s %s\n", row.stage.c_str(), row.what.c_str(),
              row.variant.c_str(), row.value, row.unit.c_str(), row.note.c_str());
  std::fflush(stdout);
  rows_.push_back(std::move(row));
}

void Rows::fail(const std::string& what) {
  std::printf("WRONG: %s\n", what.c_str());
  failed_.push_back(what);
}

void Rows::write(const std::string& path,
                 const std::vector<std::pair<std::string, std::string>>& context) const {
  nlohmann::ordered_json json;
  for (const auto& [name, value] : context) json["context"][name] = value;
  json["failed"] = failed_;
  json["rows"] = nlohmann::ordered_json::array();
  for (const Row& row : rows_) {
    json["rows"].push_back({{"stage", row.stage},
                            {"what", row.what},
                            {"variant", row.variant},
                            {"value", row.value},
                            {"unit", row.unit},
                            {"note", row.note}});
  }
  std::ofstream file(path);
  file << json.dump(1) << '\n';
  if (!file.flush()) throw std::runtime_error("cannot write " + path);
}

double percentile(std::vector<double> values, double share) {
  const auto rank =
      static_cast<std::size_t>(std::ceil(share * static_cast<double>(values.size())) - 1);
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(std::min(rank, values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

}  // namespace hedgerow::bench
