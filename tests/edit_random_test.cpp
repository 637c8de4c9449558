// Edits of all kinds, at random, on small meshes: each leaves a sound mesh or nothing changed, says
// what it did, can be taken back and done again.
#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hedgerow/edit.h"
#include "hedgerow/validate.h"
#include "support/edit_soundness.h"
#include "support/random_edits.h"
#include "support/random_faces.h"

namespace hedgerow::test {
namespace {

constexpr int kShards = 8;
constexpr int kSteps = 60;  // edits that are tried on one mesh

/// Which elements there are of each kind, and all columns of each.
struct Elements {
  std::vector<char> is_there;
  std::vector<const std::vector<Index>*> columns;
};
Elements elements_of(const EditState& state, Element element) {
  const auto& columns = state.columns;
  Elements elements;
  switch (element) {
    case Element::vertex:
      for (const bool has : state.has_vertex) elements.is_there.push_back(has ? 1 : 0);
      elements.columns = {&columns[5]};
      break;
    case Element::halfedge:
      for (const Index next : columns[2]) elements.is_there.push_back(next != kInvalidIndex);
      elements.columns = {&columns[0], &columns[1], &columns[2], &columns[3], &columns[4]};
      break;
    case Element::face:
      for (const Index first : columns[6]) elements.is_there.push_back(first != kInvalidIndex);
      elements.columns = {&columns[6]};
      break;
  }
  return elements;
}
constexpr Element kElements[] = {Element::vertex, Element::halfedge, Element::face};

Index euler_of(const EditState& state) {
  Index count[3];
  for (const Element element : kElements) {
    const std::vector<char> is_there = elements_of(state, element).is_there;
    count[static_cast<std::size_t>(element)] =
        static_cast<Index>(std::count(is_there.begin(), is_there.end(), 1));
  }
  return count[0] - count[1] / 2 + count[2];
}

/// Compares what a record says of one kind of element with the columns before and after.
void expect_told(const Change& change, Element element, const EditState& before_state,
                 const EditState& after_state) {
  const Elements before = elements_of(before_state, element);
  const Elements after = elements_of(after_state, element);
  const auto old_count = static_cast<Index>(before.is_there.size());
  const auto new_count = static_cast<Index>(after.is_there.size());
  ASSERT_EQ(change.counts_before[static_cast<std::size_t>(element)], old_count);
  ASSERT_EQ(change.counts_after[static_cast<std::size_t>(element)], new_count);

  Index next_born = old_count;
  for (const Birth& birth : change.births) {
    if (birth.element != element) continue;
    ASSERT_EQ(birth.id, next_born++);
    ASSERT_LT(birth.source, birth.id);
    ASSERT_LT(birth.other, birth.id);
  }
  ASSERT_EQ(next_born, new_count);

  std::vector<Index> died;
  for (const Death& death : change.deaths) {
    if (death.element == element) died.push_back(death.id);
  }
  std::sort(died.begin(), died.end());
  std::vector<Index> gone;
  std::vector<Index> differs;
  for (Index i = 0; i < new_count; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const bool was_there = i >= old_count || before.is_there[k] != 0;
    if (was_there && after.is_there[k] == 0) gone.push_back(i);
    if (i >= old_count || before.is_there[k] == 0 || after.is_there[k] == 0) continue;
    const auto has_changed = [&](std::size_t c) {
      return (*before.columns[c])[k] != (*after.columns[c])[k];
    };
    bool is_different = false;
    for (std::size_t c = 0; c < before.columns.size(); ++c) is_different |= has_changed(c);
    if (is_different) differs.push_back(i);
  }
  ASSERT_EQ(died, gone);
  ASSERT_EQ(change.changed(element), differs);
}

/// An array beside the mesh for each kind of element, carried over each edit.
class Carried {
 public:
  explicit Carried(const EditMesh& mesh) {
    const Index counts[] = {mesh.vertex_count(), mesh.halfedge_count(), mesh.face_count()};
    for (std::size_t e = 0; e < 3; ++e) {
      for (Index i = 0; i < counts[e]; ++i) values_[e].push_back(1000 + i);
    }
  }
  // What was there keeps its value, what is new has that of its source.
  void carry(const Change& change) {
    for (const Element element : kElements) {
      std::vector<Index>& values = values_[static_cast<std::size_t>(element)];
      std::vector<Index> expected = values;
      for (const Birth& birth : change.births) {
        if (birth.element != element) continue;
        const auto source = static_cast<std::size_t>(birth.source);
        expected.push_back(birth.source == kInvalidIndex ? 0 : expected[source]);
      }
      apply(change, element, values);
      ASSERT_EQ(values, expected);
    }
  }
  void expect_kept(const CompactMaps& maps, const EditMesh& mesh) const {
    expect_map(maps.vertices, values_[0], mesh);
    expect_map(maps.halfedges, values_[1], mesh);
    expect_map(maps.faces, values_[2], mesh);
  }

 private:
  template <class Id>
  static void expect_map(const std::vector<Id>& map, const std::vector<Index>& values,
                         const EditMesh& mesh) {
    ASSERT_EQ(map.size(), values.size());
    const std::vector<Index> kept = compacted(map, values);
    for (std::size_t i = 0; i < map.size(); ++i) {
      if (!map[i].valid()) continue;
      ASSERT_TRUE(mesh.has(Id(static_cast<Index>(i))));
      ASSERT_EQ(kept[static_cast<std::size_t>(map[i].value)], values[i]);
    }
  }

  std::vector<Index> values_[3];
};

/// What `compact` gives: sound, in the form at the start, and the same mesh under new numbers.
void expect_compacts(const EditMesh& mesh, Form form, const Carried& carried) {
  const auto made = mesh.compact();
  if (!made) {
    ASSERT_EQ(made.error().code, ErrorCode::not_canonical);
    return;
  }
  ASSERT_TRUE(validate(made->mesh, Execution::serial()).empty());
  ASSERT_EQ(made->mesh.form(), form);
  ASSERT_NO_FATAL_FAILURE(carried.expect_kept(made->maps, mesh));
  const EditView old = mesh.view();
  made->mesh.visit([&](const auto& view) {
    for (Index i = 0; i < old.halfedge_count(); ++i) {
      const HalfedgeId h(i);
      const HalfedgeId to = made->maps.halfedges[static_cast<std::size_t>(i)];
      const bool stays = mesh.has(h) && (form == Form::closed || old.face(h).valid());
      ASSERT_EQ(to.valid(), stays) << i;
      if (!stays) continue;
      const auto map_of = [&](HalfedgeId g) {
        return made->maps.halfedges[static_cast<std::size_t>(g.value)];
      };
      const VertexId from = old.origin[h];
      ASSERT_EQ(view.origin[to], made->maps.vertices[static_cast<std::size_t>(from.value)]);
      ASSERT_EQ(view.opposite[to], map_of(old.opposite[h]));
      if (old.face(h).valid()) {
        ASSERT_EQ(view.next(to), map_of(old.next(h)));
        ASSERT_EQ(view.face(to), made->maps.faces[static_cast<std::size_t>(old.face(h).value)]);
      }
    }
  });
}

class RandomEdits : public ::testing::TestWithParam<int> {
 protected:
  // One edit, done or refused, with all that is said of it.
  void try_edit(EditMesh& mesh, Random& random, EditState& state) {
    const EditRequest request = EditPicker(mesh, random).pick();
    SCOPED_TRACE(kEditNames[static_cast<std::size_t>(request.kind)]);
    const EditCheck possible = can_edit(mesh, request);
    const Index step = possible ? euler_step(mesh, request) : 0;
    const EditResult result = do_edit(mesh, request);
    ASSERT_EQ(static_cast<bool>(result), static_cast<bool>(possible));
    const EditState after = state_of(mesh);
    if (!result) {
      ASSERT_EQ(result.error(), possible);
      ASSERT_TRUE(after == state) << name(possible.reason);
      return;
    }
    ++done_[static_cast<std::size_t>(request.kind)];
    ASSERT_EQ(find_fault(mesh, may_double_), "");
    ASSERT_EQ(euler_of(after) - euler_of(state), step);
    changes_.push_back(**result);
    const Change& change = changes_.back();
    for (const Element element : kElements) {
      ASSERT_NO_FATAL_FAILURE(expect_told(change, element, state, after));
    }
    ASSERT_TRUE(mesh.undo(change));
    ASSERT_TRUE(state_of(mesh) == state);
    ASSERT_FALSE(mesh.undo(change) && !change.writes.empty());
    ASSERT_TRUE(mesh.replay(change));
    ASSERT_TRUE(state_of(mesh) == after);
    state = after;
  }

  void edit_mesh(std::uint64_t seed) {
    const ReferenceMesh reference = random_reference_mesh(seed);
    const ReferenceMesh start = seed % 2 == 0 ? reference : reference_closed(reference);
    auto made = EditMesh::of(to_connectivity(start), Execution::serial());
    ASSERT_TRUE(made);
    EditMesh& mesh = *made;
    const EditState first = state_of(mesh);
    may_double_ = find_fault(mesh) != "";
    ASSERT_EQ(find_fault(mesh, may_double_), "");
    EditState state = first;
    Random random(seed);
    Carried carried(mesh);
    changes_.clear();
    for (int step = 0; step < kSteps; ++step) {
      SCOPED_TRACE("step " + std::to_string(step));
      const std::size_t done = changes_.size();
      ASSERT_NO_FATAL_FAILURE(try_edit(mesh, random, state));
      if (changes_.size() == done) continue;
      ASSERT_NO_FATAL_FAILURE(carried.carry(changes_.back()));
      ASSERT_NO_FATAL_FAILURE(expect_compacts(mesh, start.form, carried));
    }
    for (std::size_t i = changes_.size(); i-- > 0;) ASSERT_TRUE(mesh.undo(changes_[i]));
    ASSERT_TRUE(state_of(mesh) == first);
  }

  std::vector<std::int64_t> done_ = std::vector<std::int64_t>(kEditKinds, 0);
  std::vector<Change> changes_;
  bool may_double_ = false;
};

TEST_P(RandomEdits, LeaveASoundMeshOrNothingChanged) {
  constexpr std::uint64_t kMeshes = HEDGEROW_RANDOM_EDITS / kSteps / kShards + 1;
  const std::uint64_t first = static_cast<std::uint64_t>(GetParam()) * kMeshes;
  for (std::uint64_t seed = first; seed < first + kMeshes; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    ASSERT_NO_FATAL_FAILURE(edit_mesh(seed));
  }
  for (std::size_t kind = 0; kind < kEditKinds; ++kind) {
    EXPECT_GT(done_[kind], static_cast<std::int64_t>(kMeshes / 10)) << kEditNames[kind];
  }
}

// One process each.
INSTANTIATE_TEST_SUITE_P(First, RandomEdits, ::testing::Values(0));
INSTANTIATE_TEST_SUITE_P(Second, RandomEdits, ::testing::Values(1));
INSTANTIATE_TEST_SUITE_P(Third, RandomEdits, ::testing::Values(2));
INSTANTIATE_TEST_SUITE_P(Fourth, RandomEdits, ::testing::Values(3));
INSTANTIATE_TEST_SUITE_P(Fifth, RandomEdits, ::testing::Values(4));
INSTANTIATE_TEST_SUITE_P(Sixth, RandomEdits, ::testing::Values(5));
INSTANTIATE_TEST_SUITE_P(Seventh, RandomEdits, ::testing::Values(6));
INSTANTIATE_TEST_SUITE_P(Eighth, RandomEdits, ::testing::Values(7));

}  // namespace
}  // namespace hedgerow::test
