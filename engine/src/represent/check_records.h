#pragma once

#include <cstddef>

#include "hedgerow/result.h"

namespace hedgerow::detail {

/// The first entry of closed-form records that is out of range or that another entry contradicts.
/// After it the links may be followed. `Source` is that of number_halfedges.h, with prev(r) besides
/// and entries_of(r), which calls a function with each reference to a record that r holds.
///
/// Errors     index_out_of_range and inconsistent_table, as in dcel.h.
template <class Source>
class RecordCheck {
 public:
  explicit RecordCheck(const Source& source) : source_(source), count_(source.record_count()) {}

  Result<void> run() {
    for (Index r = 0; r < count_ && is_good(); ++r) check_range(r);
    for (Index f = 0; f < source_.face_count() && is_good(); ++f) {
      expect_below(f, source_.face_record(f), count_);
    }
    if (is_good()) {
      source_.for_each_start([&](Index r) {
        if (r != kInvalidIndex && is_good()) expect_below(kInvalidIndex, r, count_);
      });
    }
    for (Index r = 0; r < count_ && is_good(); ++r) check_links(r);
    for (Index f = 0; f < source_.face_count() && is_good(); ++f) {
      expect(source_.face_record(f), source_.face(source_.face_record(f)), f);
    }
    return result_;
  }

 private:
  [[nodiscard]] bool is_good() const noexcept { return result_.has_value(); }
  void expect_below(Index element, Index value, Index limit) {
    if (value >= 0 && value < limit) return;
    result_ = fail({ErrorCode::index_out_of_range, element, value, limit});
  }
  void expect(Index element, Index value, Index wanted) {
    if (value == wanted) return;
    result_ = fail({ErrorCode::inconsistent_table, element, value, wanted});
  }

  void check_range(Index r) {
    expect_below(r, source_.origin(r), source_.vertex_count());
    source_.for_each_entry(r, [&](Index entry) { expect_below(r, entry, count_); });
    if (source_.face(r) != kInvalidIndex) expect_below(r, source_.face(r), source_.face_count());
  }

  // That each next is answered makes it a permutation, and prev its inverse.
  void check_links(Index r) {
    const Index next = source_.next(r);
    const Index across = source_.opposite(r);
    if (is_good()) expect(next, source_.prev(next), r);
    if (is_good()) expect(across, source_.opposite(across), r);
    if (is_good() && across == r) expect(r, across, kInvalidIndex);
    if (is_good()) expect(next, source_.face(next), source_.face(r));
    if (is_good()) expect(next, source_.origin(next), source_.origin(across));
  }

  const Source& source_;
  Index count_;
  Result<void> result_;
};

}  // namespace hedgerow::detail
