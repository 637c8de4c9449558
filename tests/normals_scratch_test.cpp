#include <cstdlib>
#include <vector>

#include <gtest/gtest.h>

#include "support/allocations.h"
#include "support/normal_meshes.h"

namespace hedgerow {
namespace {

struct NormalCase {
  bool is_gather;
  NormalWeight weight;
};

Result<NormalStats> call(const NormalCase& c, const Soup& soup, const Connectivity& mesh,
                         std::vector<float>& out, const Execution& execution,
                         Workspace& workspace) {
  NormalOptions options;
  options.weight = c.weight;
  const NormalsOut to{out.data(), soup.vertex_count()};
  return c.is_gather
             ? gather_vertex_normals(mesh, soup.positions(), to, options, execution, workspace)
             : scatter_vertex_normals(soup.face_list(), soup.positions(), to, options, execution,
                                      workspace);
}

std::size_t needed(const NormalCase& c, const Soup& soup, const Connectivity& mesh,
                   const Execution& execution) {
  NormalOptions options;
  options.weight = c.weight;
  return c.is_gather ? gather_vertex_normals_scratch_bytes(mesh, options, execution)
                     : scatter_vertex_normals_scratch_bytes(soup.face_list(), options, execution);
}

std::vector<NormalCase> all_cases() {
  std::vector<NormalCase> cases;
  for (const bool is_gather : {true, false}) {
    for (const NormalWeight weight : test::kWeights) cases.push_back({is_gather, weight});
  }
  return cases;
}

TEST(NormalScratch, OfTheSizeAskedForIsEnoughAndOneByteLessIsNot) {
  const test::Executions executions;
  std::vector<Soup> soups;
  soups.push_back(test::random_soup(3, 200, 500, 3));
  soups.push_back(test::random_soup(4, 200, 300, 6));
  soups.push_back(test::wavy_fan(300));
  for (const Soup& soup : soups) {
    const Connectivity mesh = test::mesh_of(soup);
    for (const NormalCase& c : all_cases()) {
      for (const Execution& execution : executions.all()) {
        const std::size_t bytes = needed(c, soup, mesh, execution);
        std::vector<float> out(soup.xyz.size(), 5.0f);
        auto* memory = static_cast<std::byte*>(std::aligned_alloc(64, (bytes + 127) / 64 * 64));
        Workspace enough({memory, bytes});
        EXPECT_TRUE(call(c, soup, mesh, out, execution, enough));
        if (bytes > 0) {
          out.assign(out.size(), 5.0f);
          Workspace too_small({memory, bytes - 1});
          const auto result = call(c, soup, mesh, out, execution, too_small);
          ASSERT_FALSE(result);
          EXPECT_EQ(result.error().code, ErrorCode::scratch_too_small);
          EXPECT_EQ(result.error().value, static_cast<std::int64_t>(bytes - 1));
          EXPECT_EQ(result.error().limit, static_cast<std::int64_t>(bytes));
          EXPECT_EQ(out, std::vector<float>(out.size(), 5.0f));
        }
        std::free(memory);
      }
    }
  }
}

TEST(NormalScratch, OfAnySizeGivesTheAnswerOrTheErrorAndNothingElse) {
  const Soup soup = test::random_soup(6, 40, 90, 5);
  const Connectivity mesh = test::mesh_of(soup);
  const Execution execution = Execution::serial().with_grain(8);
  for (const NormalCase& c : all_cases()) {
    const std::size_t bytes = needed(c, soup, mesh, execution);
    Workspace growing;
    std::vector<float> expected(soup.xyz.size());
    ASSERT_TRUE(call(c, soup, mesh, expected, execution, growing));
    for (std::size_t size = 0; size <= bytes; size += size + 64 < bytes ? 7 : 1) {
      auto* memory = static_cast<std::byte*>(std::aligned_alloc(64, (size + 127) / 64 * 64));
      std::vector<float> out(soup.xyz.size(), 5.0f);
      Workspace fixed({memory, size});
      const auto result = call(c, soup, mesh, out, execution, fixed);
      EXPECT_EQ(result.has_value(), size >= bytes);
      EXPECT_EQ(out, result ? expected : std::vector<float>(out.size(), 5.0f));
      std::free(memory);
    }
  }
}

TEST(NormalScratch, IsNotAllocatedASecondTime) {
  std::vector<Soup> soups;
  soups.push_back(test::wavy_grid(100));
  soups.push_back(test::random_soup(4, 200, 300, 6));
  soups.push_back(test::wavy_fan(300));
  for (const Soup& soup : soups) {
    const Connectivity mesh = test::mesh_of(soup);
    std::vector<float> out(static_cast<std::size_t>(soup.face_count()) * 3 + soup.xyz.size());
    const NormalsOut to_faces{out.data(), soup.face_count()};
    for (const NormalCase& c : all_cases()) {
      Workspace workspace;
      const int at_first = test::allocation_count();
      ASSERT_TRUE(call(c, soup, mesh, out, Execution::serial(), workspace));
      EXPECT_EQ(test::allocation_count(), at_first + 1) << "the workspace, once";
      ASSERT_TRUE(call(c, soup, mesh, out, Execution::serial(), workspace));
      ASSERT_TRUE(face_normals(mesh, soup.positions(), to_faces, {}, Execution::serial()));
      EXPECT_EQ(test::allocation_count(), at_first + 1);
    }
  }
}

}  // namespace
}  // namespace hedgerow
