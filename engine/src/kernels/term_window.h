#pragma once

#include <cstddef>

#include "kernels/term_rows.h"

/// A window over the faces of a mesh, in which what their corners add is computed once for all
/// rings that meet them there. It slides along as the vertices do, where faces and vertices are in
/// a local order.
namespace hedgerow::kernels {

struct GatherInput;

class TermWindow {
 public:
  /// Faces in a window over so many, a power of two: those of two rows of a grid of 64M triangles,
  /// or half of that where corners differ. And the bytes of one, up to 384 KB.
  [[nodiscard]] static Index capacity_for(Index face_count, NormalWeight weight) noexcept;
  [[nodiscard]] static std::size_t bytes(Index capacity, NormalWeight weight) noexcept;

  /// None.
  TermWindow() = default;
  /// An empty one in `bytes(capacity, weight)` of memory, 64-byte aligned.
  TermWindow(std::byte* memory, Index capacity, NormalWeight weight) noexcept;

  /// Makes the window hold the faces [low, high] round some vertices, if it can and that is worth
  /// its while: each vertex earns it some faces, which it spends where it has to compute others. So
  /// a bad order costs a bounded share more than no window. Which way is taken shows in no bit of a
  /// result.
  [[nodiscard]] bool reach(Index low, Index high, Index vertices,
                           const GatherInput& input) noexcept {
    const Index earned = credit_ + kEarned * vertices;
    credit_ = earned < capacity_ ? earned : capacity_;
    const Index first = low & ~(kStep - 1);
    const Index last = (high & ~(kStep - 1)) + kStep;
    if (first >= begin_ && last <= end_) [[likely]]
      return true;
    return move(first, last, input);
  }

  /// Rows for each face f of the window, from row `rows_of(weight)` times (f mod capacity) on.
  [[nodiscard]] const TermRow* rows() const noexcept { return rows_; }
  [[nodiscard]] Index capacity() const noexcept { return capacity_; }
  /// The row behind them is zeros: to add it changes no sum, as none is a negative zero.
  [[nodiscard]] Index zero_row() const noexcept { return capacity_ * row_count_; }

 private:
  static constexpr Index kStep = 64;   // faces computed together at the least
  static constexpr Index kEarned = 4;  // by a vertex: twice the faces that come with it

  bool move(Index first, Index last, const GatherInput& input) noexcept;
  bool pay(Index faces) noexcept;
  void fill(Index begin, Index end, const GatherInput& input) const noexcept;

  TermRow* rows_ = nullptr;
  Index capacity_ = 0;
  Index row_count_ = 0;  // a face
  Index begin_ = 0;      // the faces [begin, end) are in it
  Index end_ = 0;
  Index credit_ = 0;
};

}  // namespace hedgerow::kernels
