#pragma once

#include <algorithm>
#include <cstdint>

#include "hedgerow/index.h"
#include "hedgerow/topology.h"

/// The relations between columns that hold any values at all. Nothing is followed before it is
/// known to be in range, and no walk visits a half-edge twice.
///
/// Each function calls `report(relation, element, expected, got)` for each relation that fails, and
/// throws only what that throws.
namespace hedgerow::kernels {

/// In the order of the table in validate.cpp, which has their texts.
enum class Relation : std::uint8_t {
  opposite_not_self,
  opposite_of_opposite,
  opposite_in_closed_form,
  origin_of_opposite,
  origin_of_next_of_opposite,
  face_along_cycle,
  one_predecessor,
  face_of_first,
  three_sides,
  origin_of_outgoing,
  origin_of_fan,
  met_once,
  met_at_all,
  fans_need_outgoing,
  fans_by_vertex,
  fans_by_smallest,
  start_at_open_end,
  start_on_boundary,
  origin_in_range,
  opposite_in_range,
  next_in_range,
  face_in_range,
  outgoing_in_range,
  first_in_range,
  fan_vertex_in_range,
  fan_start_in_range,
  first_ascends,
  first_of_triangle,
  last_first,
  inside_its_face,
  next_in_a_row,
};

/// `next`, `face` and `first` null: triangles, by arithmetic.
struct MeshColumns {
  const Index* origin = nullptr;
  const Index* opposite = nullptr;
  const Index* outgoing = nullptr;
  const Index* next_of = nullptr;
  const Index* face_of = nullptr;
  const Index* first_of = nullptr;
  FanTable fans;
  Index vertex_count = 0;
  Index halfedge_count = 0;
  Index face_count = 0;
  bool is_closed_form = false;
  bool is_triangle_mesh = false;

  [[nodiscard]] bool has_vertex(Index v) const noexcept { return v >= 0 && v < vertex_count; }
  [[nodiscard]] bool has_halfedge(Index h) const noexcept { return h >= 0 && h < halfedge_count; }
  [[nodiscard]] bool has_face(Index f) const noexcept { return f >= 0 && f < face_count; }
  [[nodiscard]] bool is_explicit() const noexcept { return next_of != nullptr; }
  [[nodiscard]] Index next(Index h) const noexcept {
    return is_explicit() ? next_of[h] : h % 3 == 2 ? h - 2 : h + 1;
  }
  [[nodiscard]] Index face(Index h) const noexcept { return is_explicit() ? face_of[h] : h / 3; }
  /// The half-edge before `h` in its face, where the faces are stored in runs; else -1.
  [[nodiscard]] Index prev(Index h) const noexcept {
    if (!is_explicit()) return h % 3 == 0 ? h + 2 : h - 1;
    if (!has_face(face_of[h])) return kInvalidIndex;
    const Index end = first_of[face_of[h] + 1];
    if (end < 1 || end > halfedge_count) return kInvalidIndex;
    const Index before = h == first_of[face_of[h]] ? end - 1 : h - 1;
    return has_halfedge(before) && next_of[before] == h ? before : kInvalidIndex;
  }
};

/// I1 and I2 of one half-edge.
template <class Report>
void check_opposite(Index h, const MeshColumns& mesh, const Report& report) {
  const Index opposite = mesh.opposite[h];
  if (opposite == kInvalidIndex) {
    if (mesh.is_closed_form) report(Relation::opposite_in_closed_form, h, 0, opposite);
    return;
  }
  if (!mesh.has_halfedge(opposite)) {
    return report(Relation::opposite_in_range, h, mesh.halfedge_count, opposite);
  }
  if (opposite == h) return report(Relation::opposite_not_self, h, kInvalidIndex, h);
  if (mesh.opposite[opposite] != h) {
    report(Relation::opposite_of_opposite, h, h, mesh.opposite[opposite]);
  }
  const Index next = mesh.next(h);
  if (mesh.has_halfedge(next) && mesh.origin[opposite] != mesh.origin[next]) {
    report(Relation::origin_of_opposite, h, mesh.origin[next], mesh.origin[opposite]);
  }
  const Index next_of_opposite = mesh.next(opposite);
  if (mesh.has_halfedge(next_of_opposite) && mesh.origin[next_of_opposite] != mesh.origin[h]) {
    report(Relation::origin_of_next_of_opposite, h, mesh.origin[h], mesh.origin[next_of_opposite]);
  }
}

/// I3, I7 and I8 of one half-edge of a mesh that stores `next` and `face`.
template <class Report>
void check_place(Index h, const MeshColumns& mesh, const Report& report) {
  const Index next = mesh.next_of[h];
  const Index face = mesh.face_of[h];
  if (!mesh.has_halfedge(next)) {
    report(Relation::next_in_range, h, mesh.halfedge_count, next);
  } else if (mesh.face_of[next] != face) {
    report(Relation::face_along_cycle, h, face, mesh.face_of[next]);
  }
  if (face == kInvalidIndex && mesh.is_closed_form) {
    const Index side_count = mesh.first_of[mesh.face_count];
    if (h < side_count) report(Relation::inside_its_face, h, side_count, h);
    return;
  }
  if (!mesh.has_face(face)) return report(Relation::face_in_range, h, mesh.face_count, face);
  const Index begin = mesh.first_of[face];
  const Index end = mesh.first_of[face + 1];
  if (h < begin || h >= end) return report(Relation::inside_its_face, h, begin, h);
  const Index following = h + 1 < end ? h + 1 : begin;
  if (next != following) report(Relation::next_in_a_row, h, following, next);
}

template <class Report>
void check_halfedge(Index h, const MeshColumns& mesh, const Report& report) {
  if (!mesh.has_vertex(mesh.origin[h])) {
    report(Relation::origin_in_range, h, mesh.vertex_count, mesh.origin[h]);
  }
  check_opposite(h, mesh, report);
  if (mesh.is_explicit()) check_place(h, mesh, report);
}

/// I4, I7 and I8 of one face of a mesh that stores `first`.
template <class Report>
void check_face(Index f, const MeshColumns& mesh, const Report& report) {
  const Index first = mesh.first_of[f];
  if (mesh.first_of[f + 1] < first) {
    report(Relation::first_ascends, f, first, mesh.first_of[f + 1]);
  }
  if (mesh.is_triangle_mesh && first != 3 * f) {
    report(Relation::first_of_triangle, f, 3 * static_cast<std::int64_t>(f), first);
  }
  if (!mesh.has_halfedge(first)) {
    return report(Relation::first_in_range, f, mesh.halfedge_count, first);
  }
  if (mesh.face_of[first] != f) report(Relation::face_of_first, f, f, mesh.face_of[first]);
  Index h = first;
  for (Index sides = 1; sides < 3; ++sides) {
    h = mesh.next_of[h];
    if (!mesh.has_halfedge(h)) return;
    if (h == first) return report(Relation::three_sides, f, 3, sides);
  }
}

/// Follows one fan of `v`; marks in `met` the half-edges it meets, all of which leave `v`. Returns
/// the smallest one, or -1 if the rotation does not come to a proper end.
template <class Report>
Index check_rotation(Index v, Index start, const MeshColumns& mesh, std::uint8_t* met,
                     const Report& report) {
  Index smallest = start;
  bool is_on_boundary = false;
  Index h = start;
  do {
    if (met[h] != 0) {
      report(Relation::met_once, v, 1, 2);
      return kInvalidIndex;
    }
    met[h] = 1;
    smallest = std::min(smallest, h);
    is_on_boundary |= mesh.face(h) == kInvalidIndex;
    const Index opposite = mesh.opposite[h];
    if (opposite == kInvalidIndex) break;
    if (!mesh.has_halfedge(opposite)) return kInvalidIndex;
    h = mesh.next(opposite);
    if (!mesh.has_halfedge(h) || mesh.origin[h] != v) return kInvalidIndex;
  } while (h != start);

  if (mesh.is_closed_form) {
    if (is_on_boundary && mesh.face(start) != kInvalidIndex) {
      report(Relation::start_on_boundary, v, kInvalidIndex, mesh.face(start));
    }
  } else if (mesh.opposite[h] == kInvalidIndex) {
    const Index before = mesh.prev(start);
    if (before != kInvalidIndex && mesh.opposite[before] != kInvalidIndex) {
      report(Relation::start_at_open_end, v, kInvalidIndex, mesh.opposite[before]);
    }
  }
  return smallest;
}

/// I5 and I6 of one vertex. Race-free: vertices mark disjoint half-edges, those that leave them.
template <class Report>
void check_vertex(Index v, const MeshColumns& mesh, std::uint8_t* met, const Report& report) {
  const FanTable others = extra_fans(mesh.fans, VertexId(v));
  const Index start = mesh.outgoing[v];
  Index last_smallest = kInvalidIndex;
  if (start == kInvalidIndex) {
    if (!others.empty()) report(Relation::fans_need_outgoing, v, others[0].start.value, start);
  } else if (!mesh.has_halfedge(start)) {
    report(Relation::outgoing_in_range, v, mesh.halfedge_count, start);
  } else if (mesh.origin[start] != v) {
    report(Relation::origin_of_outgoing, v, v, mesh.origin[start]);
  } else {
    last_smallest = check_rotation(v, start, mesh, met, report);
  }
  for (const FanStart& fan : others) {
    if (!mesh.has_halfedge(fan.start.value)) continue;  // an entry of the table, checked as such
    if (mesh.origin[fan.start.value] != v) {
      report(Relation::origin_of_fan, v, v, mesh.origin[fan.start.value]);
      continue;
    }
    const Index smallest = check_rotation(v, fan.start.value, mesh, met, report);
    if (smallest == kInvalidIndex) continue;
    if (smallest < last_smallest) report(Relation::fans_by_smallest, v, last_smallest, smallest);
    last_smallest = smallest;
  }
}

/// One entry of the fan table.
template <class Report>
void check_fan(Index i, const MeshColumns& mesh, const Report& report) {
  const FanStart& fan = mesh.fans[static_cast<std::size_t>(i)];
  if (!mesh.has_vertex(fan.vertex.value)) {
    report(Relation::fan_vertex_in_range, i, mesh.vertex_count, fan.vertex.value);
  }
  if (!mesh.has_halfedge(fan.start.value)) {
    report(Relation::fan_start_in_range, i, mesh.halfedge_count, fan.start.value);
  }
  if (i == 0) return;
  const VertexId before = mesh.fans[static_cast<std::size_t>(i - 1)].vertex;
  if (fan.vertex < before) report(Relation::fans_by_vertex, i, before.value, fan.vertex.value);
}

/// Half-edges that no rotation of their origin has met.
template <class Report>
void check_met(Index h, const MeshColumns& mesh, const std::uint8_t* met, const Report& report) {
  if (met[h] == 0 && mesh.has_vertex(mesh.origin[h])) report(Relation::met_at_all, h, 1, 0);
}

}  // namespace hedgerow::kernels
