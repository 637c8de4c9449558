#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "runner.h"

namespace hedgerow::bench {

/// What the command line says about what to measure.
struct PlanOptions {
  std::vector<std::string> meshes;  ///< files to measure on as well
  std::vector<int> threads;         ///< empty: one, and all processors
  std::int64_t largest = 0;         ///< triangles of the largest meshes; 0: as `largest_mesh` says
  bool is_smoke = false;
  bool is_recorded = false;     ///< for the tables of PERF.md, and nothing that is not in them
  bool is_counted = false;      ///< for bench/limits.py as well
  bool is_imr = false;          ///< the IMR 2011 suite, and nothing else
  bool is_represented = false;  ///< the representations, on generated meshes, and nothing else
};

/// Triangles of a mesh that is ten times as large as the last-level cache, or as many as a quarter
/// of the memory and two minutes allow, in whole millions.
[[nodiscard]] std::int64_t largest_mesh();

/// Throws std::runtime_error if a mesh cannot be read.
[[nodiscard]] Plan make_plan(const PlanOptions& options);

}  // namespace hedgerow::bench
