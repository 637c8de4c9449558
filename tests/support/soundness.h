#pragma once

#include <algorithm>
#include <cstddef>
#include <map>
#include <set>
#include <vector>

#include "support/reference_mesh.h"

namespace hedgerow::test {

/// I1 to I8 in the plainest form, for columns of the right lengths that hold any values.
class Soundness {
 public:
  explicit Soundness(const ReferenceMesh& mesh) : m_(mesh) {}

  bool holds() const {
    return ranges() && opposites() && cycles() && faces() && fans_in_order() && vertices();
  }

 private:
  static std::size_t position(Index i) { return static_cast<std::size_t>(i); }
  bool is_halfedge(Index h) const { return h >= 0 && h < m_.halfedge_count(); }
  bool is_closed() const { return m_.form == Form::closed; }

  bool ranges() const {
    for (Index h = 0; h < m_.halfedge_count(); ++h) {
      const Index v = m_.origin[position(h)];
      const Index f = m_.face[position(h)];
      if (v < 0 || v >= m_.vertex_count() || !is_halfedge(m_.next[position(h)])) return false;
      if (!is_halfedge(m_.opposite[position(h)]) &&
          (m_.opposite[position(h)] != -1 || is_closed())) {
        return false;
      }
      if ((f < 0 || f >= m_.face_count()) && (f != -1 || !is_closed())) return false;
    }
    for (const Index h : m_.outgoing) {
      if (h != -1 && !is_halfedge(h)) return false;
    }
    for (const FanStart& fan : m_.fans) {
      const Index v = fan.vertex.value;
      if (v < 0 || v >= m_.vertex_count() || !is_halfedge(fan.start.value)) return false;
    }
    return true;
  }
  bool opposites() const {
    for (Index h = 0; h < m_.halfedge_count(); ++h) {
      const Index o = m_.opposite[position(h)];
      if (o == -1) continue;
      if (o == h || m_.opposite[position(o)] != h) return false;
      if (m_.origin[position(o)] != m_.origin[position(m_.next[position(h)])]) return false;
    }
    return true;
  }
  bool cycles() const {
    const std::set<Index> targets(m_.next.begin(), m_.next.end());
    if (static_cast<Index>(targets.size()) != m_.halfedge_count()) return false;
    for (Index h = 0; h < m_.halfedge_count(); ++h) {
      if (m_.face[position(m_.next[position(h)])] != m_.face[position(h)]) return false;
    }
    return true;
  }
  // The half-edges of the faces one after the other, then those of the holes.
  bool faces() const {
    Index h = 0;
    for (Index f = 0; f < m_.face_count(); ++f) {
      if (m_.first[position(f)] != h) return false;
      const Index begin = h;
      while (is_halfedge(h) && m_.face[position(h)] == f) {
        const bool is_last = !is_halfedge(h + 1) || m_.face[position(h + 1)] != f;
        if (m_.next[position(h)] != (is_last ? begin : h + 1)) return false;
        ++h;
      }
      if (h - begin < 3) return false;
    }
    if (m_.first[position(m_.face_count())] != h) return false;
    for (; h < m_.halfedge_count(); ++h) {
      if (m_.face[position(h)] != -1) return false;
    }
    return true;
  }
  bool fans_in_order() const {
    return std::is_sorted(m_.fans.begin(), m_.fans.end(),
                          [](const FanStart& a, const FanStart& b) { return a.vertex < b.vertex; });
  }
  bool vertices() const {
    std::map<Index, std::vector<Index>> leaving;
    for (Index h = 0; h < m_.halfedge_count(); ++h) leaving[m_.origin[position(h)]].push_back(h);
    for (Index v = 0; v < m_.vertex_count(); ++v) {
      std::vector<Index> met;
      Index last_smallest = -1;
      const auto starts = m_.fan_starts(v);
      if (m_.outgoing[position(v)] == -1 && !starts.empty()) return false;
      for (const Index start : starts) {
        if (m_.origin[position(start)] != v) return false;
        const std::vector<Index> fan = rotation(start);
        const Index smallest = *std::min_element(fan.begin(), fan.end());
        if (smallest < last_smallest || !starts_well(fan)) return false;
        last_smallest = smallest;
        met.insert(met.end(), fan.begin(), fan.end());
      }
      std::sort(met.begin(), met.end());
      if (met != leaving[v]) return false;
    }
    return true;
  }
  std::vector<Index> rotation(Index start) const {
    std::vector<Index> fan = {start};
    while (m_.opposite[position(fan.back())] != -1) {
      const Index h = m_.next[position(m_.opposite[position(fan.back())])];
      if (h == start) break;
      fan.push_back(h);
    }
    return fan;
  }
  bool starts_well(const std::vector<Index>& fan) const {
    if (is_closed()) {
      const bool is_on_boundary =
          std::any_of(fan.begin(), fan.end(), [&](Index h) { return m_.face[position(h)] == -1; });
      return !is_on_boundary || m_.face[position(fan[0])] == -1;
    }
    if (m_.opposite[position(fan.back())] != -1) return true;
    const auto before = std::find(m_.next.begin(), m_.next.end(), fan[0]);
    return m_.opposite[static_cast<std::size_t>(before - m_.next.begin())] == -1;
  }

  const ReferenceMesh& m_;
};

}  // namespace hedgerow::test
