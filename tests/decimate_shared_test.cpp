// Decimation in rounds beside a queue, on a scan.
#include <gtest/gtest.h>

#include "hedgerow/build.h"
#include "hedgerow/decimate.h"
#include "hedgerow/io/read.h"
#include "hedgerow/validate.h"
#include "support/shared_folder.h"

namespace hedgerow::test {
namespace {

TEST(DecimateShared, CostsHardlyMoreInRoundsThanInAQueue) {
  const auto shared = shared_folder();
  if (!shared) GTEST_SKIP() << kNoSharedFolder;
  const auto file = io::read(*shared / "meshes" / "armadillo_100k.obj");
  ASSERT_TRUE(file);
  const auto built = build(file->soup.face_list(), {}, Execution::serial());
  ASSERT_TRUE(built);
  DecimateOptions options;
  options.faces = built->mesh.face_count() / 10;
  const auto queue = decimate(built->mesh, file->soup.positions(), options, Execution::serial());
  options.order = DecimateOrder::rounds;
  const auto rounds = decimate(built->mesh, file->soup.positions(), options, Execution::serial());
  ASSERT_TRUE(queue && rounds);
  EXPECT_EQ(rounds->end, queue->end);
  EXPECT_LE(rounds->mesh.face_count(), options.faces);
  EXPECT_TRUE(validate(rounds->mesh, Execution::serial()).empty());
  EXPECT_GT(queue->total_cost, 0);
  EXPECT_LT(rounds->total_cost, 1.1 * queue->total_cost);
  EXPECT_GE(10 * rounds->accepted, 9 * rounds->candidates);
}

}  // namespace
}  // namespace hedgerow::test
