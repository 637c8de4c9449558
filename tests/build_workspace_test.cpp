#include <random>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "hedgerow/build.h"
#include "hedgerow/digest.h"
#include "hedgerow/shapes.h"
#include "support/allocations.h"

namespace hedgerow {
namespace {

BuildOptions with(BuildWorkspace* workspace, BuildStrategy strategy) {
  BuildOptions options;
  options.borrow_corners = true;
  options.strategy = strategy;
  options.workspace = workspace;
  return options;
}

std::uint64_t digest_of(const Soup& soup, const BuildOptions& options) {
  auto built = build(soup.face_list(), options, Execution::serial());
  EXPECT_TRUE(built);
  return built ? digest(built->mesh, Execution::serial()) : 0;
}

std::vector<Soup> soups_to_build() {
  std::vector<Soup> all;
  all.push_back(*shapes::grid(100, 50));
  all.push_back(shapes::shuffled(*shapes::grid(300, 200), 1));
  all.push_back(*shapes::quad_grid(40, 40));
  all.push_back(*shapes::fan(500));
  all.push_back(*shapes::grid(3, 2));
  all.push_back(Soup());
  return all;
}

TEST(BuildWorkspace, ChangesNoResultWhateverWasBuiltBefore) {
  const std::vector<Soup> all = soups_to_build();
  std::mt19937 random(7);
  BuildWorkspace workspace;
  for (int i = 0; i < 60; ++i) {
    const Soup& soup = all[random() % all.size()];
    const auto strategy = static_cast<BuildStrategy>(random() % 3);
    EXPECT_EQ(digest_of(soup, with(&workspace, strategy)), digest_of(soup, with(nullptr, strategy)))
        << "build " << i << ", " << soup.face_count() << " faces";
  }
}

TEST(BuildWorkspace, SurvivesAMoveAndTheMeshesItHelpedToBuild) {
  const Soup soup = *shapes::grid(20, 20);
  BuildWorkspace workspace;
  const auto first =
      build(soup.face_list(), with(&workspace, BuildStrategy::automatic), Execution::serial());
  ASSERT_TRUE(first);
  const std::uint64_t expected = digest(first->mesh, Execution::serial());
  BuildWorkspace moved = std::move(workspace);
  EXPECT_EQ(digest_of(soup, with(&moved, BuildStrategy::automatic)), expected);
  moved = BuildWorkspace();
  EXPECT_EQ(digest(first->mesh, Execution::serial()), expected);
}

TEST(BuildWorkspace, LeavesASecondBuildOnlyItsResultToAllocate) {
  for (const Soup& soup : soups_to_build()) {
    if (!soup.offsets.empty() || soup.face_count() == 0) continue;
    for (const auto strategy : {BuildStrategy::window, BuildStrategy::partition}) {
      BuildWorkspace workspace;
      const BuildOptions options = with(&workspace, strategy);
      ASSERT_TRUE(build(soup.face_list(), options, Execution::serial()));
      const int before = test::allocation_count();
      const auto built = build(soup.face_list(), options, Execution::serial());
      EXPECT_EQ(test::allocation_count() - before, 2)
          << "opposite and outgoing; " << soup.face_count() << " faces";
      ASSERT_TRUE(built);
    }
  }
}

}  // namespace
}  // namespace hedgerow
