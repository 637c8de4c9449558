// Each edit on a mesh small enough to draw, and the reasons for which it is refused.
#include "hedgerow/edit.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hedgerow/validate.h"
#include "support/edit_mesh.h"
#include "support/edit_soundness.h"
#include "support/meshes.h"

namespace hedgerow::test {
namespace {

/// Two triangles on the edge from 1 to 2.
PlainFaces two_triangles() { return {{{0, 1, 2}, {1, 3, 2}}, 4}; }

std::vector<Index> corners(const EditMesh& mesh, Index f) {
  std::vector<Index> out;
  const EditView view = mesh.view();
  for (const VertexId v : vertices(view, FaceId(f))) out.push_back(v.value);
  return out;
}
Refusal reason(const EditResult& result) { return result ? Refusal::none : result.error().reason; }
HalfedgeId between(const EditMesh& mesh, Index a, Index b) {
  return mesh.find(VertexId(a), VertexId(b));
}

TEST(Flip, TurnsTheDiagonalOfTwoTriangles) {
  EditMesh mesh = edit_mesh(two_triangles());
  ASSERT_TRUE(mesh.flip(between(mesh, 1, 2)));
  EXPECT_FALSE(between(mesh, 1, 2).valid());
  EXPECT_TRUE(between(mesh, 0, 3).valid());
  EXPECT_EQ(find_fault(mesh), "");
  EXPECT_EQ(reason(mesh.flip(between(mesh, 0, 1))), Refusal::boundary);
  EXPECT_EQ(reason(mesh.flip(HalfedgeId(99))), Refusal::no_such_element);
}

TEST(Flip, RefusesAnEdgeThatIsThereAlready) {
  EditMesh mesh = edit_mesh(tetrahedron());
  const EditResult result = mesh.flip(between(mesh, 0, 1));
  EXPECT_EQ(reason(result), Refusal::duplicate_edge);
  const HalfedgeId there(result.error().element);
  EXPECT_TRUE(there == between(mesh, 2, 3) || there == between(mesh, 3, 2));
  EXPECT_STREQ(name(Refusal::duplicate_edge), "duplicate-edge");
}

TEST(SplitEdge, JoinsTheNewVertexToBothSides) {
  EditMesh mesh = edit_mesh(two_triangles());
  const EditResult result = mesh.split_edge(between(mesh, 1, 2));
  ASSERT_TRUE(result);
  EXPECT_EQ(mesh.vertex_count(), 5);
  EXPECT_EQ(mesh.face_count(), 4);
  for (Index v = 0; v < 4; ++v) EXPECT_TRUE(between(mesh, 4, v).valid()) << v;
  ASSERT_EQ((*result)->births.front().element, Element::vertex);
  EXPECT_EQ((*result)->births.front().source, 1);
  EXPECT_EQ((*result)->births.front().other, 2);
}

TEST(SplitFace, JoinsTheNewVertexToAllCorners) {
  EditMesh mesh = edit_mesh(mixed_row());
  const EditResult result = mesh.split_face(FaceId(0));
  ASSERT_TRUE(result);
  EXPECT_EQ(mesh.face_count(), 7);
  for (Index v = 0; v < 5; ++v) EXPECT_TRUE(between(mesh, 9, v).valid()) << v;
  EXPECT_EQ(corners(mesh, 0).size(), 3U);
}

TEST(Connect, CutsAFaceAndJoiningItGivesItBack) {
  EditMesh mesh = edit_mesh({{{0, 1, 2, 3, 4}}, 5});
  const HalfedgeId h = between(mesh, 0, 1);
  EXPECT_EQ(reason(mesh.connect(h, between(mesh, 1, 2))), Refusal::adjacent);
  EXPECT_EQ(reason(mesh.connect(h, h)), Refusal::same_vertex);
  ASSERT_TRUE(mesh.connect(h, between(mesh, 2, 3)));
  EXPECT_EQ(corners(mesh, 0), (std::vector<Index>{0, 1, 2}));
  EXPECT_EQ(corners(mesh, 1), (std::vector<Index>{2, 3, 4, 0}));
  ASSERT_TRUE(mesh.join_faces(between(mesh, 2, 0)));
  EXPECT_EQ(corners(mesh, 0).size(), 5U);
  EXPECT_FALSE(mesh.has(FaceId(1)));
}

TEST(Collapse, TakesTheEdgeAndItsTrianglesAway) {
  EditMesh mesh = edit_mesh(hexagon_of_triangles());
  ASSERT_TRUE(mesh.collapse(between(mesh, 3, 0)));
  EXPECT_FALSE(mesh.has(VertexId(3)));
  EXPECT_EQ(find_fault(mesh), "");
  const auto compacted = mesh.compact();
  ASSERT_TRUE(compacted);
  EXPECT_EQ(compacted->mesh.face_count(), 4);
  EXPECT_EQ(compacted->mesh.vertex_count(), 6);
  EXPECT_EQ(compacted->maps.vertices[3], VertexId());
  EXPECT_EQ(compacted->maps.vertices[4], VertexId(3));
  EXPECT_TRUE(validate(compacted->mesh, Execution::serial()).empty());
}

TEST(Collapse, RefusesWhereTheLinkConditionFails) {
  // Of a tetrahedron two faces with the same vertices would be left.
  EditMesh closed = edit_mesh(tetrahedron());
  EXPECT_EQ(reason(closed.collapse(between(closed, 0, 1))), Refusal::duplicate_face);
  // Both ends on the boundary, the edge not.
  EditMesh strip = edit_mesh(two_triangles());
  EXPECT_EQ(reason(strip.collapse(between(strip, 1, 2))), Refusal::several_fans);
  // One triangle would leave an edge without a face.
  EditMesh one = edit_mesh({{{0, 1, 2}}, 3});
  EXPECT_EQ(reason(one.collapse(between(one, 0, 1))), Refusal::boundary);
}

TEST(SplitVertex, IsTheInverseOfACollapse) {
  EditMesh mesh = edit_mesh(hexagon_of_triangles());
  ASSERT_TRUE(mesh.split_vertex(between(mesh, 3, 0), between(mesh, 3, 6)));
  EXPECT_EQ(find_fault(mesh), "");
  EXPECT_TRUE(between(mesh, 3, 7).valid());
  ASSERT_TRUE(mesh.collapse(between(mesh, 7, 3)));
  EXPECT_TRUE(between(mesh, 3, 0).valid());
  EXPECT_EQ(reason(mesh.split_vertex(between(mesh, 3, 0), between(mesh, 3, 0))), Refusal::adjacent);
}

TEST(AddFace, FillsAHoleAndRefusesASideThatIsTaken) {
  EditMesh mesh = edit_mesh(tetrahedron());
  ASSERT_TRUE(mesh.remove_face(FaceId(0)));
  const std::vector<VertexId> hole = {VertexId(0), VertexId(1), VertexId(2)};
  EXPECT_EQ(reason(mesh.add_face(std::vector{hole[0], hole[2], hole[1]})), Refusal::boundary);
  EXPECT_EQ(reason(mesh.add_face(std::vector{hole[0], hole[1]})), Refusal::too_few_corners);
  EXPECT_EQ(reason(mesh.add_face(std::vector{hole[0], hole[1], hole[0]})), Refusal::same_vertex);
  ASSERT_TRUE(mesh.add_face(hole));
  const auto compacted = mesh.compact();
  ASSERT_TRUE(compacted);
  EXPECT_EQ(compacted->mesh.face_count(), 4);
  EXPECT_EQ(compacted->mesh.form(), Form::open);
}

TEST(RemoveVertex, TakesItsFacesAlong) {
  EditMesh mesh = edit_mesh(hexagon_of_triangles());
  ASSERT_TRUE(mesh.remove_vertex(VertexId(3)));
  for (Index f = 0; f < 6; ++f) EXPECT_FALSE(mesh.has(FaceId(f)));
  EXPECT_TRUE(mesh.has(VertexId(0)));
  EXPECT_FALSE(mesh.view().outgoing[VertexId(0)].valid());
  ASSERT_TRUE(mesh.add_vertex());
  EXPECT_TRUE(mesh.has(VertexId(7)));
}

TEST(Cut, DoublesWhatItPassesAndZippingSewsItUp) {
  EditMesh mesh = edit_mesh(hexagon_of_triangles());
  const HalfedgeId inner = between(mesh, 3, 0);
  EXPECT_EQ(reason(mesh.cut(std::vector{between(mesh, 0, 1)})), Refusal::boundary);
  ASSERT_TRUE(mesh.cut(std::vector{inner}));
  EXPECT_EQ(mesh.vertex_count(), 8);
  EXPECT_EQ(find_fault(mesh), "");
  const EditView view = mesh.view();
  HalfedgeId into = view.opposite[inner];  // runs to vertex 3 along the slit
  ASSERT_FALSE(view.face(into).valid());
  ASSERT_TRUE(mesh.zip(into));
  EXPECT_EQ(find_fault(mesh), "");
  const auto compacted = mesh.compact();
  ASSERT_TRUE(compacted);
  EXPECT_EQ(compacted->mesh.vertex_count(), 7);
}

// Two edges without a face, from 0 to 1 and on to 2.
TEST(Zip, MakesOneDanglingEdgeOfTwo) {
  ReferenceMesh path;
  path.origin = {0, 1, 2, 1};
  path.next = {1, 2, 3, 0};
  path.opposite = {3, 2, 1, 0};
  path.face = {-1, -1, -1, -1};
  path.outgoing = {0, 1, 2};
  path.form = Form::closed;
  path.first = {0};
  EditMesh mesh = std::move(*EditMesh::of(to_connectivity(path), Execution::serial()));
  ASSERT_EQ(find_fault(mesh), "");
  const EditState before = state_of(mesh);
  const EditResult result = mesh.zip(HalfedgeId(0));
  ASSERT_TRUE(result);
  EXPECT_EQ(find_fault(mesh), "");
  EXPECT_FALSE(mesh.has(VertexId(2)));
  EXPECT_TRUE(between(mesh, 0, 1).valid());
  const Change change = **result;
  EXPECT_EQ(change.deaths.size(), 3U);
  ASSERT_TRUE(mesh.undo(change));
  EXPECT_TRUE(state_of(mesh) == before);
}

TEST(Edits, RefuseAVertexWithSeveralFans) {
  EditMesh mesh = edit_mesh(bowtie());
  EXPECT_EQ(reason(mesh.collapse(between(mesh, 0, 2))), Refusal::several_fans);
  EXPECT_EQ(reason(mesh.remove_face(FaceId(0))), Refusal::several_fans);
}

TEST(Changes, CarryArraysAlong) {
  EditMesh mesh = edit_mesh(two_triangles());
  std::vector<std::string> labels = {"a", "b", "c", "d"};
  std::vector<int> groups = {10, 20};
  const EditResult result = mesh.split_edge(between(mesh, 1, 2));
  ASSERT_TRUE(result);
  apply(**result, Element::vertex, labels);
  apply(**result, Element::face, groups);
  EXPECT_EQ(labels, (std::vector<std::string>{"a", "b", "c", "d", "b"}));
  EXPECT_EQ(groups, (std::vector<int>{10, 20, 10, 20}));
  EXPECT_TRUE((*result)->changed(Element::vertex).empty());
  ASSERT_TRUE(mesh.remove_face(FaceId(0)));
  const auto result_of_compact = mesh.compact();
  ASSERT_TRUE(result_of_compact);
  EXPECT_EQ(compacted(result_of_compact->maps.faces, groups), (std::vector<int>{20, 10, 20}));
}

TEST(Changes, AreNotKeptWhereNobodyWantsThem) {
  EditMesh mesh = edit_mesh(two_triangles());
  mesh.set_recording(false);
  const EditResult result = mesh.flip(between(mesh, 1, 2));
  ASSERT_TRUE(result);
  EXPECT_TRUE((*result)->writes.empty());
  EXPECT_EQ(mesh.undo(**result).reason, Refusal::other_state);
}

}  // namespace
}  // namespace hedgerow::test
