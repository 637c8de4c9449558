#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include <gtest/gtest.h>

#include "hedgerow/circulate.h"
#include "hedgerow/query.h"
#include "support/reference_mesh.h"

namespace hedgerow::test {

/// Asks a view of any representation every question about single elements, in both directions of
/// rotation, and compares the answers with walks over the reference columns.
template <Topology View>
class SameAnswers {
 public:
  /// `number_of[h]` is what the view calls half-edge h of the reference.
  SameAnswers(const View& view, const ReferenceMesh& mesh, const std::vector<Index>& number_of)
      : view_(view), mesh_(mesh), number_of_(number_of) {}

  void expect_all() const {
    ASSERT_EQ(view_.vertex_count(), mesh_.vertex_count());
    ASSERT_EQ(view_.face_count(), mesh_.face_count());
    for (Index h = 0; h < mesh_.halfedge_count(); ++h) expect_halfedge(h);
    for (Index f = 0; f < mesh_.face_count(); ++f) expect_face(f);
    for (Index v = 0; v < mesh_.vertex_count(); ++v) expect_vertex(v);
  }

 private:
  using Numbers = std::vector<Index>;

  static std::size_t at(Index i) { return static_cast<std::size_t>(i); }
  template <class Range>
  static Numbers numbers(const Range& range) {
    Numbers out;
    for (const auto id : range) out.push_back(id.value);
    return out;
  }
  Numbers renumbered(Numbers halfedges) const {
    for (Index& h : halfedges) h = number(h).value;
    return halfedges;
  }
  HalfedgeId number(Index h) const { return HalfedgeId(h < 0 ? h : number_of_[at(h)]); }
  Index next(Index h) const { return mesh_.next[at(h)]; }
  Index opposite(Index h) const { return mesh_.opposite[at(h)]; }
  bool is_side(Index h) const { return h >= 0 && mesh_.face[at(h)] >= 0; }

  void expect_halfedge(Index h) const {
    const HalfedgeId n = number(h);
    EXPECT_EQ(view_.origin[n].value, mesh_.origin[at(h)]);
    EXPECT_EQ(view_.target(n).value, mesh_.origin[at(next(h))]);
    EXPECT_EQ(view_.face(n).value, mesh_.face[at(h)]);
    EXPECT_EQ(view_.next(n), number(next(h)));
    EXPECT_EQ(view_.prev(n), number(mesh_.prev[at(h)]));
    EXPECT_EQ(view_.opposite[n], number(opposite(h)));
    EXPECT_EQ(is_boundary(view_, n), !is_side(h) || opposite(h) < 0);
    EXPECT_EQ(is_boundary_edge(view_, n), !is_side(h) || !is_side(opposite(h)));
    Numbers cycle;
    for (Index g = h; cycle.empty() || g != h; g = next(g)) cycle.push_back(g);
    EXPECT_EQ(numbers(halfedges_from(view_, n)), renumbered(cycle));
    EXPECT_EQ(degree(view_, n), static_cast<Index>(cycle.size()));
    if (is_side(h) && opposite(h) >= 0) return;
    EXPECT_EQ(numbers(boundary_loop(view_, n)), renumbered(loop(h)));
  }
  Numbers loop(Index h) const {
    Numbers out;
    for (Index g = h; out.empty() || g != h;) {
      out.push_back(g);
      const bool turns = is_side(g);
      g = next(g);
      while (turns && opposite(g) >= 0) g = next(opposite(g));
    }
    return out;
  }

  void expect_face(Index f) const {
    Numbers sides;
    Numbers corners;
    Numbers across;
    for (Index h = mesh_.first[at(f)]; h < mesh_.first[at(f + 1)]; ++h) {
      sides.push_back(h);
      corners.push_back(mesh_.origin[at(h)]);
      if (is_side(opposite(h))) across.push_back(mesh_.face[at(opposite(h))]);
    }
    const FaceId id(f);
    EXPECT_EQ(numbers(halfedges(view_, id)), renumbered(sides));
    EXPECT_EQ(numbers(vertices(view_, id)), corners);
    EXPECT_EQ(numbers(adjacent_faces(view_, id)), across);
    EXPECT_EQ(view_.degree(id), static_cast<Index>(sides.size()));
    EXPECT_EQ(adjacent_face_count(view_, id), static_cast<Index>(across.size()));
    EXPECT_EQ(is_boundary(view_, id), across.size() != sides.size());
  }

  void expect_vertex(Index v) const {
    Numbers clockwise;
    Numbers counter_clockwise;
    Numbers ring;
    Numbers faces;
    bool is_on_boundary = false;
    for (const Index start : mesh_.fan_starts(v)) {
      Numbers fan = {start};
      while (opposite(fan.back()) >= 0 && next(opposite(fan.back())) != start) {
        fan.push_back(next(opposite(fan.back())));
      }
      const Index before = mesh_.prev[at(start)];
      const bool is_open = is_side(start) && opposite(before) < 0;
      if (is_open) ring.push_back(mesh_.origin[at(before)]);
      for (const Index h : fan) {
        ring.push_back(mesh_.origin[at(next(h))]);
        if (is_side(h)) faces.push_back(mesh_.face[at(h)]);
        is_on_boundary |= is_open || !is_side(h);
      }
      clockwise.insert(clockwise.end(), fan.begin(), fan.end());
      std::reverse(fan.begin() + (is_open ? 0 : 1), fan.end());
      counter_clockwise.insert(counter_clockwise.end(), fan.begin(), fan.end());
    }
    const VertexId id(v);
    EXPECT_EQ(numbers(outgoing_halfedges(view_, id)), renumbered(clockwise));
    EXPECT_EQ(numbers(outgoing_halfedges<Rotation::counter_clockwise>(view_, id)),
              renumbered(counter_clockwise));
    EXPECT_EQ(numbers(neighbours(view_, id)), ring);
    EXPECT_EQ(numbers(incident_faces(view_, id)), faces);
    EXPECT_EQ(valence(view_, id), static_cast<Index>(ring.size()));
    EXPECT_EQ(is_boundary(view_, id), is_on_boundary);
  }

  const View& view_;
  const ReferenceMesh& mesh_;
  const std::vector<Index>& number_of_;
};

template <Topology View>
void expect_same_answers(const View& view, const ReferenceMesh& mesh,
                         const std::vector<Index>& number_of) {
  SameAnswers<View>(view, mesh, number_of).expect_all();
}

}  // namespace hedgerow::test
