#pragma once

#include <map>
#include <string>
#include <vector>

#include "baselines/bandwidth.h"
#include "runner.h"

namespace hedgerow::bench {

/// Rates of one bandwidth kernel, one a round.
struct Bandwidth {
  baselines::StreamKernel kernel = baselines::StreamKernel::read;
  std::vector<double> gb_per_s;
};

/// One line of the results: a case and every time that was taken of it.
struct Row {
  std::string name;
  std::string error;                  ///< why there are no times, or empty
  std::vector<double> times_ns;       ///< one a round
  std::vector<double> processor_ns;   ///< of all threads, in the same rounds
  std::vector<Bandwidth> bandwidths;  ///< same mix, bytes, threads and rounds
  Counts counts;
  double mesh_bytes = 0;
  Traffic traffic;
  Mix mix = Mix::triad;
  std::map<std::string, double> notes;
};

/// Writes the machine and the rows as JSON, a row a line, so that a change shows as changed lines.
/// Throws std::runtime_error if that fails.
void write_results(const std::string& path, const std::vector<Row>& rows, int rounds);

}  // namespace hedgerow::bench
