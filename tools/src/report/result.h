#pragma once

#include <string>
#include <vector>

#include "baselines/bandwidth.h"
#include "inspection.h"
#include "machine.h"
#include "report/rays.h"
#include "report/stage.h"

namespace hedgerow::tool {

/// What `report` found, ready to be printed and written.
struct ReportResult {
  std::string mesh_name;
  Machine machine;
  baselines::Bandwidth bandwidth;
  Inspection inspection;
  std::vector<Stage> stages;
  RayFacts rays;
  std::vector<std::string> failed;  ///< answers that were wrong, and so were not timed
  std::vector<std::string> files;   ///< written beside the report, and the report itself
};

/// Stages and files of a full report that this program does not make.
[[nodiscard]] std::vector<std::string> absent_parts();

/// The object of CLI.md.
[[nodiscard]] Json report_json(const ReportResult& result);
[[nodiscard]] std::string report_text(const ReportResult& result, bool colour);

}  // namespace hedgerow::tool
