#include "hedgerow/validate.h"

#include <algorithm>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hedgerow/boundary.h"
#include "hedgerow/build.h"
#include "support/meshes.h"
#include "support/numbers.h"
#include "support/random_faces.h"
#include "support/reference_mesh.h"
#include "support/soundness.h"

namespace hedgerow::test {
namespace {

std::string text(const std::vector<Violation>& violations) {
  std::string all;
  for (const Violation& v : violations) {
    all += "I" + std::to_string(v.invariant) + " of " + std::to_string(v.element) + ": " +
           v.relation + ", expected " + std::to_string(v.expected) + ", got " +
           std::to_string(v.got) + "\n";
  }
  return all;
}

std::vector<Violation> check(const ReferenceMesh& mesh, bool store_all = true) {
  return validate(to_connectivity(mesh, store_all), Execution::serial());
}

void expect_violation(const std::vector<Violation>& found, int invariant, ElementKind kind,
                      Index element, std::int64_t expected, std::int64_t got) {
  const bool is_there = std::any_of(found.begin(), found.end(), [&](const Violation& v) {
    return v.invariant == invariant && v.kind == kind && v.element == element &&
           v.expected == expected && v.got == got;
  });
  EXPECT_TRUE(is_there) << text(found);
}

TEST(Validate, FindsNothingWrongWithSoundMeshes) {
  for (const PlainFaces& plain : {hexagon_of_triangles(), tetrahedron(), bowtie(), mixed_row(),
                                  three_on_an_edge(), closed_and_open_fan(), PlainFaces{}}) {
    const ReferenceMesh mesh = reference_of(plain);
    EXPECT_EQ(text(check(mesh)), "");
    EXPECT_EQ(text(check(mesh, /*store_all=*/false)), "");
    EXPECT_EQ(text(check(reference_closed(mesh))), "");
  }
  EXPECT_TRUE(validate(Connectivity(), Execution::serial()).empty());
}

TEST(Validate, NamesAHalfedgeOppositeToItself) {
  ReferenceMesh mesh = reference_of(bowtie());
  mesh.opposite[1] = 1;
  expect_violation(check(mesh), 1, ElementKind::halfedge, 1, -1, 1);
}

TEST(Validate, NamesAHalfedgeWhoseOppositeIsAnothers) {
  ReferenceMesh mesh = reference_of(tetrahedron());
  const Index other = mesh.opposite[3];
  mesh.opposite[0] = other;
  const auto found = check(mesh);
  expect_violation(found, 1, ElementKind::halfedge, 0, 0, 3);
  EXPECT_TRUE(std::any_of(found.begin(), found.end(), [](const Violation& v) {
    return v.invariant == 2;
  })) << text(found);
}

TEST(Validate, NamesTheVertexWhoseOutgoingHalfedgeLeavesAnother) {
  ReferenceMesh mesh = reference_of(hexagon_of_triangles());
  mesh.outgoing[3] = 0;
  expect_violation(check(mesh), 5, ElementKind::vertex, 3, 3, 0);
}

TEST(Validate, NamesTheHalfedgesThatNoRotationMeets) {
  ReferenceMesh mesh = reference_of(bowtie());
  const Index unmet = mesh.fans[0].start.value;
  mesh.fans.clear();
  const auto found = check(mesh);
  ASSERT_EQ(found.size(), 1U) << text(found);
  expect_violation(found, 5, ElementKind::halfedge, unmet, 1, 0);
}

TEST(Validate, NamesTheVertexWhoseFanIsListedTwice) {
  ReferenceMesh mesh = reference_of(bowtie());
  mesh.fans.push_back(mesh.fans[0]);
  expect_violation(check(mesh), 5, ElementKind::vertex, 2, 1, 2);
}

TEST(Validate, NamesTheBoundaryVertexThatStartsInTheMiddle) {
  ReferenceMesh mesh = reference_of(hexagon_of_triangles());
  ASSERT_EQ(mesh.outgoing[0], 3);
  mesh.outgoing[0] = 0;  // the fan of vertex 0 is 3, 0
  expect_violation(check(mesh), 6, ElementKind::vertex, 0, -1, 3);
}

TEST(Validate, NamesTheBoundaryVertexThatStartsAtAFaceInTheClosedForm) {
  ReferenceMesh mesh = reference_closed(reference_of(hexagon_of_triangles()));
  mesh.outgoing[0] = 3;
  expect_violation(check(mesh), 6, ElementKind::vertex, 0, -1, 1);
}

TEST(Validate, NamesWhatIsOutOfRange) {
  ReferenceMesh mesh = reference_of(tetrahedron());
  mesh.origin[5] = 4;
  expect_violation(check(mesh), 7, ElementKind::halfedge, 5, 4, 4);
  mesh.origin[5] = std::numeric_limits<Index>::min();
  expect_violation(check(mesh, /*store_all=*/false), 7, ElementKind::halfedge, 5, 4,
                   std::numeric_limits<Index>::min());
}

TEST(Validate, NamesAHoleThatIsNoPermutation) {
  ReferenceMesh mesh = reference_closed(reference_of(bowtie()));
  const Index target = mesh.next[6];
  mesh.next[7] = target;
  expect_violation(check(mesh), 3, ElementKind::halfedge, target, 1, 2);
}

TEST(Validate, NamesAFaceWithTwoSides) {
  ReferenceMesh mesh = reference_of(mixed_row());
  mesh.next[10] = 9;
  expect_violation(check(mesh), 4, ElementKind::face, 2, 3, 2);
}

TEST(Validate, NamesAColumnOfAnotherLength) {
  ConnectivityColumns columns = to_columns(reference_of(tetrahedron()), true);
  columns.opposite = Buffer<Index>(11, Index{-1});
  const auto found = validate(Connectivity(std::move(columns)), Execution::serial());
  ASSERT_EQ(found.size(), 1U);
  expect_violation(found, 7, ElementKind::mesh, kInvalidIndex, 12, 11);
}

TEST(Validate, TakesAFanOfAMillionTriangles) {
  constexpr Index kCount = 1'000'000;
  Buffer<Index> corners(3 * at(kCount));
  for (Index i = 0; i < kCount; ++i) {
    corners[3 * at(i)] = kCount;
    corners[3 * at(i) + 1] = i;
    corners[3 * at(i) + 2] = (i + 1) % kCount;
  }
  const auto built = build(FaceList::triangles<Index>(corners.span(), kCount + 1), BuildOptions{},
                           Execution::current_arena());
  ASSERT_TRUE(built);
  EXPECT_TRUE(validate(built->mesh, Execution::current_arena()).empty());
  const auto closed = close_boundary(built->mesh, Execution::current_arena());
  ASSERT_TRUE(closed);
  EXPECT_TRUE(validate(*closed, Execution::current_arena()).empty());
}

// The values that one entry is changed to.
std::vector<Index> other_values(Index value, Index count) {
  std::set<Index> values = {-2,
                            -1,
                            0,
                            1,
                            value - 1,
                            value + 1,
                            value + 3,
                            count - 1,
                            count,
                            count / 2,
                            std::numeric_limits<Index>::max(),
                            std::numeric_limits<Index>::min()};
  values.erase(value);
  return {values.begin(), values.end()};
}

// Whether a violation speaks of what was spoilt: a half-edge, or what its columns refer to before
// and after; a vertex or face, or the half-edges that it names.
bool speaks_of(const Violation& v, const ReferenceMesh& sound, const ReferenceMesh& spoilt,
               const std::string& column, Index entry) {
  if (v.kind == ElementKind::mesh) return column == "first" || column.substr(0, 4) == "fans";
  std::set<Index> halfedges;
  std::set<Index> vertices;
  std::set<Index> faces;
  const auto add_halfedge = [&](const ReferenceMesh& m, Index h) {
    if (h < 0 || h >= m.halfedge_count()) return;
    halfedges.insert({h, m.opposite[at(h)], m.next[at(h)], m.prev[at(h)]});
    vertices.insert({m.origin[at(h)], m.origin[at(sound.next[at(h)])]});
    faces.insert(m.face[at(h)]);
  };
  for (const ReferenceMesh* m : {&sound, &spoilt}) {
    if (column == "outgoing") {
      vertices.insert(entry);
      add_halfedge(*m, m->outgoing[at(entry)]);
    } else if (column == "first") {
      faces.insert({entry - 1, entry});
      for (Index h = 0; h < m->halfedge_count(); ++h) {
        if (m->face[at(h)] == entry || m->face[at(h)] == entry - 1) halfedges.insert(h);
      }
    } else if (column.substr(0, 4) == "fans") {
      vertices.insert(m->fans[at(entry)].vertex.value);
      add_halfedge(*m, m->fans[at(entry)].start.value);
    } else {
      add_halfedge(*m, entry);
      add_halfedge(*m, m->opposite[at(entry)]);
    }
  }
  return v.kind == ElementKind::halfedge ? halfedges.count(v.element) > 0
         : v.kind == ElementKind::vertex ? vertices.count(v.element) > 0
                                         : faces.count(v.element) > 0;
}

void expect_same_verdict(const ReferenceMesh& sound, const ReferenceMesh& spoilt,
                         const char* column, std::size_t entry, Index value) {
  const auto found = check(spoilt);
  EXPECT_TRUE(found.empty() || std::any_of(found.begin(), found.end(),
                                           [&](const Violation& v) {
                                             return speaks_of(v, sound, spoilt, column,
                                                              static_cast<Index>(entry));
                                           }))
      << column << "[" << entry << "] = " << value << "\n"
      << text(found);
  EXPECT_EQ(found.empty(), Soundness(spoilt).holds())
      << column << "[" << entry << "] = " << value << "\n"
      << text(found);
  for (const Violation& v : found) EXPECT_TRUE(v.invariant >= 1 && v.invariant <= 8);
}

void spoil_each_entry(const ReferenceMesh& sound) {
  ReferenceMesh mesh = sound;
  const auto spoil = [&](const char* name, std::vector<Index>& column, Index count) {
    for (std::size_t i = 0; i < column.size() && !::testing::Test::HasFailure(); ++i) {
      const Index value = column[i];
      for (const Index other : other_values(value, count)) {
        column[i] = other;
        expect_same_verdict(sound, mesh, name, i, other);
      }
      column[i] = value;
    }
  };
  const Index halfedges = sound.halfedge_count();
  spoil("origin", mesh.origin, sound.vertex_count());
  spoil("opposite", mesh.opposite, halfedges);
  spoil("next", mesh.next, halfedges);
  spoil("face", mesh.face, sound.face_count());
  spoil("first", mesh.first, halfedges);
  spoil("outgoing", mesh.outgoing, halfedges);
  for (std::size_t i = 0; i < mesh.fans.size(); ++i) {
    const FanStart fan = mesh.fans[i];
    for (const Index other : other_values(fan.start.value, halfedges)) {
      mesh.fans[i].start = HalfedgeId(other);
      expect_same_verdict(sound, mesh, "fans.start", i, other);
    }
    mesh.fans[i] = fan;
    for (const Index other : other_values(fan.vertex.value, sound.vertex_count())) {
      mesh.fans[i].vertex = VertexId(other);
      expect_same_verdict(sound, mesh, "fans.vertex", i, other);
    }
    mesh.fans[i] = fan;
  }
}

class ValidateOracle : public ::testing::TestWithParam<std::uint64_t> {};

TEST_P(ValidateOracle, FindsEveryCorruptionOfOneEntry) {
  const std::uint64_t seed = GetParam();
  SCOPED_TRACE("seed " + std::to_string(seed));
  const ReferenceMesh mesh = random_reference_mesh(seed);
  if (mesh.halfedge_count() > 60) return;
  spoil_each_entry(mesh);
  spoil_each_entry(reference_closed(mesh));
}
INSTANTIATE_TEST_SUITE_P(Seeds, ValidateOracle, ::testing::Range<std::uint64_t>(0, 40));

// All columns garbage at once: nothing may be read out of bounds or go round for ever.
TEST(ValidateGarbage, SurvivesAnyValuesAndGivesOneListForEverySchedule) {
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    Random random(seed);
    ReferenceMesh mesh = random_reference_mesh(seed);
    if (seed % 2 == 0) mesh = reference_closed(mesh);
    for (auto* column :
         {&mesh.origin, &mesh.opposite, &mesh.next, &mesh.face, &mesh.first, &mesh.outgoing}) {
      for (Index& value : *column) {
        if (random.one_in(3)) value = random.below(mesh.halfedge_count() + 4) - 2;
        if (random.one_in(50)) value = static_cast<Index>(random.below(1LL << 62));
      }
    }
    for (FanStart& fan : mesh.fans) fan.start = HalfedgeId(random.below(Index{50}) - 2);
    const Connectivity connectivity = to_connectivity(mesh, true);
    const std::string serial = text(validate(connectivity, Execution::serial()));
    EXPECT_EQ(serial, text(validate(connectivity, Execution::current_arena().with_grain(1))));
    EXPECT_EQ(serial.empty(), Soundness(mesh).holds());
  }
}

// The builder's meshes, in both forms, satisfy what it promises.
TEST(ValidateBuilder, FindsNothingWrongWithWhatTheBuilderMakes) {
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    const PlainFaces plain = random_good_faces(seed);
    std::vector<Index> corners;
    std::vector<Index> offsets = {0};
    for (const Corners& face : plain.faces) {
      for (const std::int64_t v : face) corners.push_back(static_cast<Index>(v));
      offsets.push_back(static_cast<Index>(corners.size()));
    }
    auto built = build(FaceList::polygons<Index>(corners, offsets, plain.vertex_count),
                       BuildOptions{}, Execution::serial());
    ASSERT_TRUE(built);
    EXPECT_EQ(text(validate(built->mesh, Execution::serial())), "") << "seed " << seed;
    const auto closed = close_boundary(built->mesh, Execution::serial());
    ASSERT_TRUE(closed);
    EXPECT_EQ(text(validate(*closed, Execution::serial())), "") << "seed " << seed;
    built->mesh.materialise(Execution::serial());
    EXPECT_EQ(text(validate(built->mesh, Execution::serial())), "") << "seed " << seed;
  }
}

}  // namespace
}  // namespace hedgerow::test
