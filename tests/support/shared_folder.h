#pragma once

#include <filesystem>
#include <optional>

namespace hedgerow::test {

/// The folder of shared meshes: the environment variable HEDGEROW_SHARED, else `../shared` beside
/// the project. None if it is missing: the test then says so with `GTEST_SKIP() <<
/// kNoSharedFolder`.
[[nodiscard]] std::optional<std::filesystem::path> shared_folder();

inline constexpr const char* kNoSharedFolder =
    "the folder of shared meshes is missing (HEDGEROW_SHARED or ../shared)";

}  // namespace hedgerow::test
