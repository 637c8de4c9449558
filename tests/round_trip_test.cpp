// Every representation there and back, on as many small meshes as the preset has time for.
#include <cstdint>
#include <string>

#include <gtest/gtest.h>

#include "support/plain_build.h"
#include "support/random_faces.h"
#include "support/round_trips.h"

namespace hedgerow::test {
namespace {

/// Every tenth has faces with any vertices at all, so that a third is not manifold.
PlainFaces list_of(std::uint64_t seed) {
  if (seed % 10 != 0) return random_good_faces(seed);
  Random random(seed);
  return random_clutter(random);
}

class RoundTrips : public ::testing::TestWithParam<int> {};

TEST_P(RoundTrips, LoseNothingOfRandomMeshes) {
  constexpr std::uint64_t kCount = HEDGEROW_ROUND_TRIPS / 4;
  const std::uint64_t first = static_cast<std::uint64_t>(GetParam()) * kCount;
  std::uint64_t nonmanifold = 0;
  for (std::uint64_t seed = first; seed < first + kCount; ++seed) {
    const auto built = build_plain(list_of(seed));
    ASSERT_TRUE(built) << "seed " << seed;
    nonmanifold += std::ranges::any_of(built->defects, [](const Defect& defect) {
      return defect.kind == DefectKind::nonmanifold_edge ||
             defect.kind == DefectKind::nonmanifold_vertex;
    });
    const std::string fault = find_lossy_round_trip(built->mesh);
    ASSERT_EQ(fault, "") << "seed " << seed;
  }
  EXPECT_GT(nonmanifold, kCount / 3);
}

// One process each.
INSTANTIATE_TEST_SUITE_P(FirstQuarter, RoundTrips, ::testing::Values(0));
INSTANTIATE_TEST_SUITE_P(SecondQuarter, RoundTrips, ::testing::Values(1));
INSTANTIATE_TEST_SUITE_P(ThirdQuarter, RoundTrips, ::testing::Values(2));
INSTANTIATE_TEST_SUITE_P(LastQuarter, RoundTrips, ::testing::Values(3));

}  // namespace
}  // namespace hedgerow::test
