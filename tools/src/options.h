#pragma once

#include <array>

#include "hedgerow/defect.h"

namespace CLI {
class App;
}

namespace hedgerow::tool {

/// What every command understands.
struct Options {
  bool json = false;
  bool quiet = false;
  bool no_progress = false;
  bool strict = false;
  int threads = 0;  ///< 0: as many as there are processors
  Policies policies;
  std::array<bool, kDefectKindCount> is_policy_given{};
  bool keep_non_finite = false;
};

/// More threads than this are taken for a slip of the hand.
inline constexpr int kMaxThreads = 4096;

/// Adds the options of every command to `app`, in a group of their own.
void add_options(CLI::App& app, Options& options);

}  // namespace hedgerow::tool
