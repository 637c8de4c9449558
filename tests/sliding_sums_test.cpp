// The window of sums that slides over a task: it changes no bit, whatever passes under it.
#include "scatter/sliding_sums.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "hedgerow/shapes.h"
#include "support/normal_meshes.h"

namespace hedgerow {
namespace {

// Vertices: a window of so many holds a run of faces of a narrow mesh.
constexpr Index kBlock = 2048;

// Narrow and long, so that few vertices are needed at once.
Soup ribbon() { return *shapes::grid(10, 6000); }

Soup backwards(const Soup& soup) {
  Soup copy = test::copy_of(soup);
  for (std::size_t f = 0; f < copy.corners.size() / 6; ++f) {
    const std::size_t other = copy.corners.size() / 3 - 1 - f;
    for (std::size_t k = 0; k < 3; ++k) {
      std::swap(copy.corners[3 * f + k], copy.corners[3 * other + k]);
    }
  }
  return copy;
}

// With `count` more vertices from `begin` on, which are on no face.
Soup with_gap(const Soup& soup, Index begin, Index count) {
  Soup wider = test::copy_of(soup);
  wider.xyz = Buffer<float>(soup.xyz.size() + 3 * static_cast<std::size_t>(count), 0.5F);
  const auto before = 3 * static_cast<std::ptrdiff_t>(begin);
  const auto after = before + 3 * static_cast<std::ptrdiff_t>(count);
  std::copy_n(soup.xyz.begin(), before, wider.xyz.begin());
  std::copy(soup.xyz.begin() + before, soup.xyz.end(), wider.xyz.begin() + after);
  for (Index& v : wider.corners) v += v >= begin ? count : 0;
  return wider;
}

// A vertex in a hundred is so far away that its sum leaves the range of float, another is where the
// next one is.
Soup with_extremes(const Soup& soup) {
  Soup copy = test::copy_of(soup);
  for (std::size_t i = 0; i + 156 <= copy.xyz.size(); i += 300) {
    copy.xyz[i] = 1e25F;
    float* const xyz = copy.xyz.data() + i + 150;
    std::copy_n(xyz + 3, 3, xyz);
  }
  return copy;
}

// Faces as they come but for one, from the first vertex to the last.
Soup with_chord(const Soup& soup) {
  Soup copy = test::copy_of(soup);
  const std::size_t middle = copy.corners.size() / 6 * 3;
  copy.corners[middle] = 0;
  copy.corners[middle + 1] = soup.vertex_count() - 1;
  return copy;
}

std::vector<std::pair<std::string, Soup>> soups() {
  std::vector<std::pair<std::string, Soup>> all;
  all.emplace_back("ribbon", ribbon());
  all.emplace_back("backwards", backwards(ribbon()));
  all.emplace_back("ring", *shapes::torus(6000, 10));
  all.emplace_back("gap", with_gap(ribbon(), 30000, 9000));
  all.emplace_back("gaps at the ends", with_gap(with_gap(ribbon(), 66011, 5000), 0, 5000));
  all.emplace_back("extremes", with_extremes(ribbon()));
  all.emplace_back("chord", with_chord(ribbon()));
  return all;
}

// Tasks that slide and tasks that have more vertices than a window, where each has four blocks.
std::pair<Index, Index> sliding_of(const Soup& soup) {
  const FaceList faces = soup.face_list();
  const kernels::FaceSource source(faces);
  const Execution execution = Execution::serial().with_grain(kBlock);
  const detail::ScatterPlan plan = detail::scatter_plan(faces, execution);
  Buffer<std::byte> memory(plan.table_bytes());
  detail::RunTable table(plan, source, memory.data());
  EXPECT_TRUE(table.fill(execution));
  const detail::WindowPlan windows(table, 4);
  return {windows.sliding_count(), windows.large_count()};
}

TEST(SlidingSums, SlideWhereFacesAndVerticesAreInOneOrder) {
  using Counts = std::pair<Index, Index>;
  EXPECT_EQ(sliding_of(ribbon()),
            Counts(8, 8));  // 66,011 vertices: eight tasks of 8,192, and a rest
  // But not where a run of faces is at both ends of a gap, of the ring, or of the chord.
  EXPECT_EQ(sliding_of(with_gap(ribbon(), 30000, 9000)), Counts(7, 9));
  EXPECT_EQ(sliding_of(*shapes::torus(6000, 10)), Counts(6, 8));
  EXPECT_EQ(sliding_of(with_chord(ribbon())), Counts(5, 8));
  EXPECT_EQ(sliding_of(backwards(ribbon())), Counts(0, 8));
}

TEST(SlidingSums, HaveTheSameBitsAsAWindowOverAllVertices) {
  for (const auto& named : soups()) {
    const std::string& name = named.first;
    const Soup& soup = named.second;
    const Connectivity mesh = test::mesh_of(soup);
    for (const NormalWeight weight : test::kWeights) {
      NormalOptions options;
      options.weight = weight;
      options.degenerate = DegeneratePolicy::axis;
      const auto run = [&](const Execution& execution) {
        return test::run(test::Method::scatter, mesh, soup.face_list(), soup.positions(), options,
                         execution);
      };
      const test::Answer whole = run(Execution::serial().with_grain(soup.vertex_count()));
      EXPECT_EQ(run(Execution::serial().with_grain(kBlock)), whole) << name << int(weight);
      EXPECT_EQ(run(Execution::current_arena().with_grain(kBlock)), whole) << name << int(weight);
      EXPECT_EQ(run(Execution::current_arena().with_grain(kBlock / 2)), whole) << name;
      EXPECT_EQ(test::run(test::Method::gather, mesh, soup.face_list(), soup.positions(), options,
                          Execution::serial()),
                whole)
          << name << int(weight);
    }
  }
}

}  // namespace
}  // namespace hedgerow
