#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "at.h"
#include "hedgerow/buffer.h"
#include "hedgerow/connectivity.h"
#include "hedgerow/numbered_mesh.h"
#include "hedgerow/result.h"

namespace hedgerow::detail {

/// Half-edges in the canonical order from records in any order. The links of the records are known
/// to be good: next is a permutation of those that exist, opposite its own inverse, and both ends
/// of an edge agree.
///
/// `Source` has record_count(), vertex_count(), face_count(); of a record exists(r), origin(r),
/// opposite(r), next(r), face(r) (-1 = none); face_record(f), one of face f or -1; and
/// for_each_start(visit), which visits records where rotations should start if it makes no
/// difference. Records that have canonical numbers keep them. Else faces are numbered in order,
/// each from its record on, then what is left in cycles: those opposite to faces in the order of
/// these, then those of dangling edges alone.
template <class Source>
class HalfedgeMaker {
 public:
  explicit HalfedgeMaker(const Source& source)
      : source_(source), halfedge_(at(source.record_count()), HalfedgeId()) {}

  /// Errors     too_few_corners; inconsistent_table: element = a record with a face that is not on
  ///            the cycle of that face's record, value = the face, limit = -1.
  Result<NumberedMesh> run() {
    if (Result<void> numbered = number_faces(); !numbered) return fail(numbered.error());
    if (is_canonical()) {
      keep_numbers();
    } else {
      number_loops();
    }
    if (Result<void> numbered = check_faces(); !numbered) return fail(numbered.error());
    fill_columns();
    find_fans();
    ConnectivityColumns columns;
    columns.form = form_;
    columns.all_triangles = all_triangles_;
    columns.origin = std::move(origin_);
    columns.opposite = std::move(opposite_);
    columns.outgoing = std::move(outgoing_);
    columns.fans = sorted_fans();
    if (!all_triangles_ || form_ == Form::closed) {
      columns.next = std::move(next_);
      columns.face = std::move(face_);
      columns.first = std::move(first_);
    }
    return NumberedMesh{Connectivity(std::move(columns)), std::move(halfedge_)};
  }

 private:
  [[nodiscard]] Index count() const noexcept { return static_cast<Index>(record_.size()); }

  // Numbers the records of a cycle in a row. Returns how many there are.
  Index number_cycle(Index start) {
    const Index before = count();
    Index r = start;
    do {
      halfedge_[at(r)] = HalfedgeId(count());
      record_.push_back(r);
      r = source_.next(r);
    } while (r != start);
    return count() - before;
  }

  Result<void> number_faces() {
    first_ = Buffer<Index>(at(source_.face_count()) + 1);
    record_.reserve(at(source_.record_count()));
    for (Index f = 0; f < source_.face_count(); ++f) {
      first_[at(f)] = count();
      const Index start = source_.face_record(f);
      const Index degree = start == kInvalidIndex ? 0 : number_cycle(start);
      if (degree < 3) return fail({ErrorCode::too_few_corners, f, degree, 3});
      all_triangles_ &= degree == 3;
    }
    first_[at(source_.face_count())] = count();
    return {};
  }

  // Whether the faces have the first numbers in the order of their corners, and all records exist.
  [[nodiscard]] bool is_canonical() const {
    for (Index h = 0; h < count(); ++h) {
      if (record_[at(h)] != h) return false;
    }
    for (Index r = count(); r < source_.record_count(); ++r) {
      if (!source_.exists(r) || source_.face(r) != kInvalidIndex) return false;
    }
    return true;
  }
  void keep_numbers() {
    for (Index r = count(); r < source_.record_count(); ++r) {
      form_ = Form::closed;
      halfedge_[at(r)] = HalfedgeId(r);
      record_.push_back(r);
    }
  }

  void number_loops() {
    const Index in_faces = count();
    const auto add_loop = [&](Index r) {
      if (r == kInvalidIndex || !source_.exists(r) || halfedge_[at(r)].valid()) return;
      if (source_.face(r) != kInvalidIndex) return;
      form_ = Form::closed;
      number_cycle(r);
    };
    for (Index h = 0; h < in_faces; ++h) add_loop(source_.opposite(record_[at(h)]));
    for (Index r = 0; r < source_.record_count(); ++r) add_loop(r);
    // A surface without boundary is the same in both forms; the default one is meant.
  }

  Result<void> check_faces() const {
    for (Index r = 0; r < source_.record_count(); ++r) {
      if (source_.exists(r) && !halfedge_[at(r)].valid()) {
        return fail({ErrorCode::inconsistent_table, r, source_.face(r), kInvalidIndex});
      }
    }
    return {};
  }

  void fill_columns() {
    const std::size_t size = record_.size();
    origin_ = Buffer<Index>(size);
    opposite_ = Buffer<Index>(size);
    next_ = Buffer<Index>(size);
    face_ = Buffer<Index>(size);
    prev_.resize(size);
    for (std::size_t h = 0; h < size; ++h) {
      const Index r = record_[h];
      const Index across = source_.opposite(r);
      origin_[h] = source_.origin(r);
      opposite_[h] = across == kInvalidIndex ? kInvalidIndex : halfedge_[at(across)].value;
      next_[h] = halfedge_[at(source_.next(r))].value;
      face_[h] = source_.face(r);
      prev_[at(next_[h])] = static_cast<Index>(h);
    }
  }

  // Fan by fan in the order of their smallest half-edges, as the core lists them.
  void find_fans() {
    std::vector<std::uint8_t> is_start(record_.size(), 0);
    source_.for_each_start([&](Index r) {
      if (r != kInvalidIndex && halfedge_[at(r)].valid()) is_start[at(halfedge_[at(r)].value)] = 1;
    });
    std::vector<std::uint8_t> is_met(record_.size(), 0);
    outgoing_ = Buffer<Index>(at(source_.vertex_count()), kInvalidIndex);
    for (Index h = 0; h < count(); ++h) {
      if (is_met[at(h)] != 0) continue;
      const Index start = start_of_fan(h, is_start);
      Index g = start;
      do {
        is_met[at(g)] = 1;
        g = clockwise(g);
      } while (g != kInvalidIndex && g != start);
      Index& outgoing = outgoing_[at(origin_[at(h)])];
      if (outgoing == kInvalidIndex) {
        outgoing = start;
      } else {
        fans_.push_back({VertexId(origin_[at(h)]), HalfedgeId(start)});
      }
    }
  }
  [[nodiscard]] Index clockwise(Index h) const {
    const Index across = opposite_[at(h)];
    return across == kInvalidIndex ? across : next_[at(across)];
  }
  [[nodiscard]] Index start_of_fan(Index h, const std::vector<std::uint8_t>& is_start) const {
    Index end = h;
    for (Index g = opposite_[at(prev_[at(h)])]; g != h; g = opposite_[at(prev_[at(g)])]) {
      if (g == kInvalidIndex) return end;
      end = g;
    }
    // It comes round, and starts on the boundary if it can, then where it did, then anywhere.
    const auto rank = [&](Index g) {
      return (face_[at(g)] == kInvalidIndex ? 0 : 2) + (is_start[at(g)] != 0 ? 0 : 1);
    };
    Index best = h;
    for (Index g = clockwise(h); g != h; g = clockwise(g)) {
      if (rank(g) < rank(best) || (rank(g) == rank(best) && g < best)) best = g;
    }
    return best;
  }
  [[nodiscard]] Buffer<FanStart> sorted_fans() {
    std::stable_sort(fans_.begin(), fans_.end(),
                     [](FanStart a, FanStart b) { return a.vertex < b.vertex; });
    return Buffer<FanStart>::copy_of(fans_);
  }

  const Source& source_;
  Buffer<HalfedgeId> halfedge_;  // by record
  std::vector<Index> record_;    // by half-edge
  std::vector<Index> prev_;
  std::vector<FanStart> fans_;
  Buffer<Index> origin_;
  Buffer<Index> opposite_;
  Buffer<Index> next_;
  Buffer<Index> face_;
  Buffer<Index> first_;
  Buffer<Index> outgoing_;
  Form form_ = Form::open;
  bool all_triangles_ = true;
};

}  // namespace hedgerow::detail
