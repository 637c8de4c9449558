#pragma once

#include <memory>

#include "dataset.h"

namespace hedgerow::bench {

/// The mesh of `data` with `next`, `face` and `first` stored, as polygons that happen to have three
/// sides: every operation reads those columns instead of computing them. Views the columns that it
/// shares with `data`, which must live longer.
[[nodiscard]] std::shared_ptr<const Connectivity> stored_form(const Dataset& data);

}  // namespace hedgerow::bench
