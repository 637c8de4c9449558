// The policy `split`: how many vertices it takes.
#include <algorithm>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "support/plain_build.h"
#include "support/random_faces.h"

namespace hedgerow::test {
namespace {

using Edge = std::pair<std::int64_t, std::int64_t>;

/// How many groups the faces at each vertex form when they are joined across the edges that two
/// faces share and run along in different directions: each needs a vertex of its own, and no more.
/// (A. Gueziec et al., "Cutting and stitching", 2001: local cutting.)
std::vector<std::size_t> groups_at_vertices(const PlainFaces& list) {
  std::map<Edge, std::vector<std::pair<std::size_t, bool>>> sides;  // face, and if it runs up
  for (std::size_t f = 0; f < list.faces.size(); ++f) {
    const auto& face = list.faces[f];
    for (std::size_t k = 0; k < face.size(); ++k) {
      const std::int64_t a = face[k];
      const std::int64_t b = face[(k + 1) % face.size()];
      sides[std::minmax(a, b)].emplace_back(f, a < b);
    }
  }
  std::vector<std::size_t> groups;
  for (std::int64_t v = 0; v < list.vertex_count; ++v) {
    std::map<std::size_t, std::size_t> group;
    for (std::size_t f = 0; f < list.faces.size(); ++f) {
      if (std::ranges::count(list.faces[f], v) > 0) group[f] = f;
    }
    for (bool is_changed = true; is_changed;) {
      is_changed = false;
      for (const auto& [edge, faces] : sides) {
        const bool joins = faces.size() == 2 && faces[0].second != faces[1].second;
        if (!joins || (edge.first != v && edge.second != v)) continue;
        std::size_t& one = group[faces[0].first];
        std::size_t& other = group[faces[1].first];
        is_changed |= one != other;
        one = other = std::min(one, other);
      }
    }
    std::set<std::size_t> distinct;
    for (const auto& [face, smallest] : group) distinct.insert(smallest);
    groups.push_back(std::max<std::size_t>(distinct.size(), 1));  // an isolated vertex stays
  }
  return groups;
}

TEST(Split, TakesAVertexForEachGroupOfFacesAndNoMore) {
  Policies policies;
  for (const DefectKind kind : {DefectKind::nonmanifold_edge, DefectKind::inconsistent_edge,
                                DefectKind::nonmanifold_vertex}) {
    policies[kind] = Action::split;
  }
  std::size_t copies = 0;
  for (std::uint64_t seed = 0; seed < 3000 && !HasFailure(); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const PlainFaces input = random_good_faces(seed);
    const auto built = build_plain(input, policies);
    ASSERT_TRUE(built);
    std::vector<std::size_t> count(static_cast<std::size_t>(input.vertex_count), 0);
    for (Index v = 0; v < built->mesh.vertex_count(); ++v) {
      const auto i = static_cast<std::size_t>(v);
      const bool has_map = !built->vertices_new_to_old.empty();
      ++count[static_cast<std::size_t>(has_map ? built->vertices_new_to_old[i] : v)];
    }
    EXPECT_EQ(count, groups_at_vertices(input));
    copies += static_cast<std::size_t>(built->mesh.vertex_count() - input.vertex_count);
  }
  EXPECT_GT(copies, 5000U);
}

}  // namespace
}  // namespace hedgerow::test
