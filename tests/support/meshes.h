#pragma once

#include "support/reference_mesh.h"

/// Meshes small enough to draw by hand.
namespace hedgerow::test {

/// Six triangles round the inner vertex 3, with seven vertices and a boundary of six edges: the
/// worked table of a DCEL, whose half-edges e0 .. e17 are 0 .. 17 here and whose v1 is vertex 0.
inline PlainFaces hexagon_of_triangles() {
  return {{{0, 2, 3}, {0, 3, 1}, {1, 3, 4}, {2, 5, 3}, {3, 5, 6}, {3, 6, 4}}, 7};
}

/// That table: origin, opposite, face, next and prev; e18 .. e23 are boundary half-edges.
inline constexpr Index kHexagonTable[24][5] = {
    {0, 18, 0, 1, 2},   {2, 11, 0, 2, 0},   {3, 3, 0, 0, 1},     {0, 2, 1, 4, 5},
    {3, 6, 1, 5, 3},    {1, 19, 1, 3, 4},   {1, 4, 2, 7, 8},     {3, 17, 2, 8, 6},
    {4, 20, 2, 6, 7},   {2, 21, 3, 10, 11}, {5, 12, 3, 11, 9},   {3, 1, 3, 9, 10},
    {3, 10, 4, 13, 14}, {5, 22, 4, 14, 12}, {6, 15, 4, 12, 13},  {3, 14, 5, 16, 17},
    {6, 23, 5, 17, 15}, {4, 7, 5, 15, 16},  {2, 0, -1, 19, 21},  {0, 5, -1, 20, 18},
    {1, 8, -1, 23, 19}, {5, 9, -1, 18, 22}, {6, 13, -1, 21, 23}, {4, 16, -1, 22, 20}};

inline PlainFaces tetrahedron() { return {{{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}}, 4}; }

/// Two triangles that share vertex 2 and no edge.
inline PlainFaces bowtie() { return {{{0, 1, 2}, {2, 3, 4}}, 5}; }

/// Three triangles on the edge (0, 1).
inline PlainFaces three_on_an_edge() { return {{{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}, 5}; }

/// A pentagon, a quad and a triangle in a row, and an isolated vertex 8.
inline PlainFaces mixed_row() { return {{{0, 1, 2, 3, 4}, {1, 5, 6, 2}, {5, 7, 6}}, 9}; }

/// A tetrahedron (closed at vertex 0) and a triangle that touches it at vertex 0 only.
inline PlainFaces closed_and_open_fan() {
  PlainFaces list = tetrahedron();
  list.faces.push_back({0, 4, 5});
  list.vertex_count = 6;
  return list;
}

/// The oracle's mesh of faces that are all good.
inline ReferenceMesh reference_of(const PlainFaces& list) {
  std::vector<std::vector<Index>> faces;
  for (const auto& face : list.faces) faces.emplace_back(face.begin(), face.end());
  return reference_mesh(faces, static_cast<Index>(list.vertex_count));
}

/// A triangle 0 1 2 in the closed form, with an edge from 0 to 3 into the outside: of the boundary
/// 3: 1 -> 0, 4: 0 -> 2, 5: 2 -> 1 and of the edge 6: 0 -> 3, 7: 3 -> 0, which come in at 0.
inline ReferenceMesh triangle_with_dangling_edge() {
  ReferenceMesh mesh = reference_closed(reference_of({{{0, 1, 2}}, 4}));
  mesh.origin.insert(mesh.origin.end(), {0, 3});
  mesh.opposite.insert(mesh.opposite.end(), {7, 6});
  mesh.face.insert(mesh.face.end(), {-1, -1});
  mesh.next.insert(mesh.next.end(), {7, 4});
  mesh.next[3] = 6;
  mesh.outgoing[3] = 7;
  return mesh;
}

}  // namespace hedgerow::test
