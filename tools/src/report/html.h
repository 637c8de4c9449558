#pragma once

#include <string>

#include "report/result.h"

namespace hedgerow::tool {

/// The report as one file that refers to no other: tables, plots and, where `png` is not empty, the
/// picture. Fits a phone and a printed page, in light and in dark.
[[nodiscard]] std::string report_html(const ReportResult& result, const std::string& png);

}  // namespace hedgerow::tool
