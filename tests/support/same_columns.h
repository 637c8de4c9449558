#pragma once

#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "support/reference_mesh.h"

namespace hedgerow::test {

/// Every stored column, the form and the fans are those of the reference.
inline void expect_same_columns(const Connectivity& mesh, const ReferenceMesh& expected) {
  const auto list = [](const Index* data, auto size) {
    return std::vector<Index>(data, data + size);
  };
  EXPECT_EQ(mesh.form(), expected.form);
  EXPECT_EQ(list(mesh.origin().data(), mesh.origin().size()), expected.origin);
  EXPECT_EQ(list(mesh.opposite().data(), mesh.opposite().size()), expected.opposite);
  EXPECT_EQ(list(mesh.outgoing().data(), mesh.outgoing().size()), expected.outgoing);
  EXPECT_EQ(std::vector<FanStart>(mesh.fans().begin(), mesh.fans().end()), expected.fans);
  EXPECT_EQ(mesh.is_triangle_mesh(), expected.is_all_triangles());
  EXPECT_EQ(mesh.face_count(), expected.face_count());
  if (!mesh.is_explicit()) return;
  const PolygonView view = mesh.polygons();
  EXPECT_EQ(list(view.next_of.data(), view.next_of.size()), expected.next);
  EXPECT_EQ(list(view.face_of.data(), view.face_of.size()), expected.face);
  EXPECT_EQ(list(view.first_of.data(), view.first_of.size()), expected.first);
}

}  // namespace hedgerow::test
