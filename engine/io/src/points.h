#pragma once

#include <vector>

#include "failure.h"
#include "hedgerow/point2.h"
#include "read_context.h"

namespace hedgerow::io {

/// The formats are described in hedgerow/io/points.h.
[[nodiscard]] Parsed<std::vector<Point2>> parse_xy(ReadContext& context);
[[nodiscard]] Parsed<std::vector<Point2>> parse_csv(ReadContext& context);

}  // namespace hedgerow::io
