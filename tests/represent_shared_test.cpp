// Every representation there and back, on every real mesh.
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "hedgerow/build.h"
#include "hedgerow/io/read.h"
#include "support/round_trips.h"
#include "support/shared_folder.h"

namespace hedgerow::test {
namespace {

TEST(RepresentShared, LosesNothingOfAnyMesh) {
  const auto shared = shared_folder();
  if (!shared) GTEST_SKIP() << kNoSharedFolder;
  int count = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(*shared / "meshes")) {
    const auto soup = io::read(entry.path());
    if (!soup)
      continue;  // the manifest and other text; that every mesh is read is tested elsewhere
    SCOPED_TRACE(entry.path().filename().string());
    const auto built = build(soup->soup.face_list(), {}, Execution::serial());
    ASSERT_TRUE(built);
    EXPECT_EQ(find_lossy_round_trip(built->mesh), "");
    ++count;
  }
  EXPECT_GT(count, 10);
}

}  // namespace
}  // namespace hedgerow::test
