// connected_components: each way it may go, against a flood of a slow mesh.
#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hedgerow/build.h"
#include "hedgerow/query.h"
#include "hedgerow/shapes.h"
#include "kernels/join_sets.h"
#include "kernels/smaller_neighbours.h"
#include "support/meshes.h"
#include "support/numbers.h"
#include "support/random_faces.h"
#include "support/reference_mesh.h"
#include "support/threads.h"

namespace hedgerow::test {
namespace {

// Quads or pairs of triangles in rows, from vertex `first` on.
void add_grid(PlainFaces& list, std::int64_t n, std::int64_t first, bool is_cut) {
  for (std::int64_t y = 0; y < n; ++y) {
    for (std::int64_t x = 0; x < n; ++x) {
      const std::int64_t a = first + y * (n + 1) + x;
      const std::int64_t b = a + n + 1;
      if (is_cut) {
        list.faces.push_back({a, a + 1, b + 1});
        list.faces.push_back({a, b + 1, b});
      } else {
        list.faces.push_back({a, a + 1, b + 1, b});
      }
    }
  }
  list.vertex_count = std::max(list.vertex_count, first + (n + 1) * (n + 1));
}

// Vertices numbered from the other end: still each but one has a smaller neighbour.
PlainFaces reversed(PlainFaces list) {
  for (auto& face : list.faces) {
    for (std::int64_t& v : face) v = list.vertex_count - 1 - v;
  }
  return list;
}

// In both forms and views, on any number of threads.
void expect_components(const PlainFaces& list) {
  const ReferenceMesh open = reference_of(list);
  const Numbers expected = reference_components(open);
  Numbers roots = expected;
  std::sort(roots.begin(), roots.end());
  roots.erase(std::unique(roots.begin(), roots.end()), roots.end());
  const auto count = static_cast<Index>(roots.size()) - (!roots.empty() && roots[0] < 0 ? 1 : 0);
  const std::array meshes = {to_connectivity(open), to_connectivity(open, true),
                             to_connectivity(reference_closed(open))};
  for (const Connectivity& mesh : meshes) {
    for (const int threads_count : kThreadCounts) {
      Threads threads(threads_count);
      for (const Index grain : {1, 7, 1000}) {
        const Components found = connected_components(mesh, threads.execution(grain));
        EXPECT_EQ(to_vector(found.label), expected) << threads_count << " threads, grain " << grain;
        EXPECT_EQ(found.count, count);
      }
    }
  }
}

bool is_shown_by_numbers(const PlainFaces& list) {
  const Connectivity mesh = to_connectivity(reference_of(list));
  Numbers labels(at(mesh.vertex_count()));
  return mesh.visit([&](const auto& view) {
    const Index root = kernels::find_used_vertex(view);
    return kernels::label_with_root({0, view.vertex_count()}, root, view, labels.data());
  });
}

TEST(Components, AreShownByTheNumbersOfAGrid) {
  for (const bool is_cut : {true, false}) {
    PlainFaces list;
    add_grid(list, 9, 0, is_cut);
    EXPECT_TRUE(is_shown_by_numbers(list));
    expect_components(list);
    EXPECT_TRUE(is_shown_by_numbers(reversed(list)));
    expect_components(reversed(list));
  }
}

TEST(Components, LeaveOutIsolatedVerticesBeforeAndBehind) {
  PlainFaces list;
  add_grid(list, 5, 3, true);
  list.vertex_count += 4;
  EXPECT_TRUE(is_shown_by_numbers(list));
  expect_components(list);
  // Few, and more than the kernel looks ahead.
  for (const std::int64_t count : {5, 500}) {
    const PlainFaces isolated{{}, count};
    EXPECT_TRUE(is_shown_by_numbers(isolated));
    expect_components(isolated);
  }
}

TEST(Components, AreJoinedWhereTheNumbersDoNotShowThem) {
  PlainFaces two;
  add_grid(two, 6, 0, true);
  add_grid(two, 4, two.vertex_count + 1, false);
  EXPECT_FALSE(is_shown_by_numbers(two));
  expect_components(two);
  // One more face leads to a vertex that is smaller than its neighbours; it stays one component.
  PlainFaces dip;
  add_grid(dip, 6, 2, true);
  dip.faces.push_back({1, dip.vertex_count - 1, dip.vertex_count});
  ++dip.vertex_count;
  EXPECT_FALSE(is_shown_by_numbers(dip));
  expect_components(dip);
}

TEST(Components, AreShownByFansOfAVertexThatOutgoingDoesNotStart) {
  // The smallest half-edge of vertex 2 is in a face of larger vertices; its other fan leads to 0.
  const PlainFaces list{{{2, 3, 4}, {0, 1, 2}}, 5};
  EXPECT_TRUE(is_shown_by_numbers(list));
  expect_components(list);
}

// Fewer faces than it takes to be scattered are joined as such by the kernel itself.
TEST(Components, AreTheSameByBothWaysOfJoiningFaces) {
  for (std::uint64_t seed = 0; seed < 500 && !HasFailure(); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const ReferenceMesh open = random_reference_mesh(seed);
    const Connectivity mesh = to_connectivity(open);
    Numbers local(at(mesh.vertex_count()));
    Numbers scattered = local;
    mesh.visit([&](const auto& view) {
      const IndexRange vertices{0, view.vertex_count()};
      const IndexRange faces{0, view.face_count()};
      kernels::fill_singletons(vertices, local.data());
      kernels::fill_singletons(vertices, scattered.data());
      kernels::join_faces<false>(faces, view, local.data());
      kernels::join_faces<true>(faces, view, scattered.data());
      (void)kernels::label_roots(vertices, view, local.data());
      (void)kernels::label_roots(vertices, view, scattered.data());
    });
    const Numbers expected = reference_components(open);
    EXPECT_EQ(local, expected);
    EXPECT_EQ(scattered, expected);
  }
}

TEST(Components, OfScatteredFacesAreLabelledTheSameForEveryThreadCount) {
  const Soup faces = shapes::shuffled(*shapes::grid(400, 400), 1);
  const auto output = build(faces.face_list(), {}, Execution::serial());
  ASSERT_TRUE(output);
  const Connectivity& mesh = output->mesh;
  EXPECT_TRUE(mesh.visit([](const auto& view) { return kernels::has_scattered_faces(view); }));
  for (const int count : kThreadCounts) {
    Threads threads(count);
    const Components found = connected_components(mesh, threads.execution(20'000));
    EXPECT_EQ(found.count, 1);
    EXPECT_EQ(to_vector(found.label), Numbers(at(mesh.vertex_count()), 0)) << count;
  }
  const auto ordered = build(shapes::grid(400, 400)->face_list(), {}, Execution::serial());
  ASSERT_TRUE(ordered);
  EXPECT_FALSE(
      ordered->mesh.visit([](const auto& view) { return kernels::has_scattered_faces(view); }));
}

}  // namespace
}  // namespace hedgerow::test
