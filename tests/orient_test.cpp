#include "hedgerow/orient.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "hedgerow/shapes.h"
#include "support/meshes.h"
#include "support/numbers.h"
#include "support/random_faces.h"
#include "support/reference_mesh.h"

namespace hedgerow::test {
namespace {

Orientation orientation_of(const Connectivity& mesh) {
  return find_orientation(mesh, build_radial(mesh, Execution::serial()));
}

std::vector<Index> flipped_of(const Orientation& found) {
  return {found.flipped.begin(), found.flipped.end()};
}

// The edges between faces that exactly two half-edges are on.
struct Joint {
  Index a, b;
  bool is_same_way;
};
std::vector<Joint> joints_of(const ReferenceMesh& mesh) {
  std::vector<Joint> joints;
  for (const auto& [ends, halfedges] : edges_of(mesh)) {
    if (halfedges.size() != 2) continue;
    const std::size_t h = at(halfedges[0]);
    const std::size_t g = at(halfedges[1]);
    joints.push_back({mesh.face[h], mesh.face[g], mesh.origin[h] == mesh.origin[g]});
  }
  return joints;
}

// Whether there is a closed walk from (f, not turned) to (f, turned): by fixed point, no walk.
std::vector<bool> orientable_faces(const ReferenceMesh& mesh, const std::vector<Joint>& joints) {
  std::vector<Index> label;
  const Index count = mesh.face_count();
  for (Index i = 0; i < 2 * count; ++i) label.push_back(i);  // face f as f and, turned, f + count
  for (bool changed = true; changed;) {
    changed = false;
    const auto join = [&](Index a, Index b) {
      changed |= label[at(a)] != label[at(b)];
      label[at(a)] = label[at(b)] = std::min(label[at(a)], label[at(b)]);
    };
    for (const Joint& joint : joints) {
      const Index turned = joint.is_same_way ? count : 0;
      join(joint.a, joint.b + turned);
      join(joint.a + count, joint.b + (count - turned));
    }
  }
  std::vector<bool> is_orientable;
  for (Index f = 0; f < count; ++f) is_orientable.push_back(label[at(f)] != label[at(f + count)]);
  return is_orientable;
}

// An odd number of the joints that the cycle passes can be chosen to be of the same way. Two faces
// may share several edges, so both ways are followed.
bool proves(const std::vector<Index>& cycle, const std::vector<Joint>& joints) {
  bool can_be_even = true;
  bool can_be_odd = false;
  for (std::size_t i = 0; i < cycle.size(); ++i) {
    const Index a = cycle[i];
    const Index b = cycle[(i + 1) % cycle.size()];
    bool even = false;
    bool odd = false;
    for (const Joint& joint : joints) {
      if (!((joint.a == a && joint.b == b) || (joint.a == b && joint.b == a))) continue;
      even |= joint.is_same_way ? can_be_odd : can_be_even;
      odd |= joint.is_same_way ? can_be_even : can_be_odd;
    }
    can_be_even = even;
    can_be_odd = odd;
  }
  return can_be_odd;
}

TEST(Orient, TurnsTheOneFaceThatDisagrees) {
  PlainFaces faces = tetrahedron();
  std::reverse(faces.faces[2].begin(), faces.faces[2].end());
  const Orientation found = orientation_of(to_connectivity(reference_of(faces)));
  EXPECT_EQ(flipped_of(found), std::vector<Index>{2});
  EXPECT_EQ(found.patch_count, 1);
  EXPECT_EQ(found.nonorientable_count, 0);
}

TEST(Orient, LeavesPatchesApartThatMeetOnACrowdedEdge) {
  const Orientation found = orientation_of(to_connectivity(reference_of(three_on_an_edge())));
  EXPECT_TRUE(found.flipped.empty());
  EXPECT_EQ(found.patch_count, 3);
}

TEST(Orient, ProvesThatAMoebiusBandHasNoOrientation) {
  const PlainFaces band = {{{0, 1, 2}, {1, 3, 2}, {2, 3, 4}, {3, 0, 4}, {4, 0, 1}}, 5};
  const ReferenceMesh plain = reference_of(band);
  const Orientation found = orientation_of(to_connectivity(plain));
  ASSERT_EQ(found.nonorientable_count, 1);
  const std::vector<Index> cycle(found.proof_faces.begin(), found.proof_faces.end());
  EXPECT_TRUE(proves(cycle, joints_of(plain)));
  EXPECT_EQ(cycle.size(), 5U);
  EXPECT_TRUE(found.flipped.empty());
}

TEST(Orient, ReportsAKleinBottle) {
  const auto soup = shapes::klein(8, 5);
  ASSERT_TRUE(soup);
  const auto built = build(soup->face_list(), {}, Execution::serial());
  ASSERT_TRUE(built);
  EXPECT_EQ(orientation_of(built->mesh).nonorientable_count, 1);
}

TEST(Orient, AgreesWithAFixedPointOnRandomFaces) {
  std::int64_t proof_count = 0;
  for (std::uint64_t seed = 0; seed < 10'000; ++seed) {
    const ReferenceMesh plain = random_reference_mesh(seed);
    const std::vector<Joint> joints = joints_of(plain);
    const std::vector<bool> is_orientable = orientable_faces(plain, joints);
    const Connectivity mesh = to_connectivity(plain);
    const RadialCycles cycles = build_radial(mesh, Execution::serial());
    const Orientation found = find_orientation(mesh, cycles);
    std::vector<bool> is_flipped(at(plain.face_count()), false);
    for (const Index f : found.flipped) is_flipped[at(f)] = true;
    for (const Joint& joint : joints) {
      if (!is_orientable[at(joint.a)]) {
        ASSERT_FALSE(is_flipped[at(joint.a)]) << "seed " << seed;
        continue;
      }
      const bool is_turned = is_flipped[at(joint.a)] != is_flipped[at(joint.b)];
      ASSERT_EQ(is_turned, joint.is_same_way) << "seed " << seed;
    }
    const Patches patches = manifold_patches(mesh, cycles, Execution::serial());
    ASSERT_EQ(found.patch_count, patches.count);
    std::vector<Index> expected;  // smallest faces of the patches without orientation
    for (Index f = 0; f < plain.face_count(); ++f) {
      const bool is_root = patches.label[at(f)] == f;
      ASSERT_FALSE(is_root && is_flipped[at(f)]) << "seed " << seed;
      if (is_root && !is_orientable[at(f)]) expected.push_back(f);
    }
    ASSERT_EQ(found.proof_first.size(), expected.size() + 1) << "seed " << seed;
    for (std::size_t i = 0; i < expected.size(); ++i, ++proof_count) {
      const std::vector<Index> cycle(found.proof_faces.begin() + found.proof_first[i],
                                     found.proof_faces.begin() + found.proof_first[i + 1]);
      ASSERT_TRUE(proves(cycle, joints)) << "seed " << seed;
      ASSERT_EQ(patches.label[at(cycle[0])], expected[i]) << "seed " << seed;
    }
  }
  EXPECT_GT(proof_count, 100);
}

}  // namespace
}  // namespace hedgerow::test
