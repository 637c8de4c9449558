#pragma once

#include "hedgerow/index.h"

/// Runs of pairs of triangles in which each pair has the corners of the one before plus one: the
/// rows of a terrain, a swept surface or a range image, whichever way their cells are cut. So has
/// every pair of triangles a mesh repeats along a row of vertices.
namespace hedgerow::kernels {

/// Corners of a pair.
inline constexpr Index kPairCorners = 6;

/// What the pairs of a run add to the vertices from `first` on, which counts from corner 0 of the
/// first pair. Pair i adds `high` to vertex first + i + 1, then pair i + 1 adds `low` to the same:
/// the order of the faces.
struct PairWindow {
  Index first = 0;
  signed char high[2] = {-1, -1};  ///< which corner of either triangle; -1: none
  signed char low[2] = {-1, -1};

  [[nodiscard]] bool has_high() const noexcept { return high[0] >= 0 || high[1] >= 0; }
};

/// The windows of a run, in an order that keeps that of the faces at every vertex. They depend on
/// how the corners of a pair lie to one another alone, which is seldom new.
class PairWindows {
 public:
  /// For a run that begins with these corners. False: one of the two triangles has a vertex twice,
  /// and there are no windows.
  [[nodiscard]] bool find(const Index* corners) noexcept {
    bool is_known = true;
    for (Index j = 0; j < kPairCorners; ++j) is_known &= offset_[j] == corners[j] - corners[0];
    return is_known ? count_ > 0 : find_new(corners);
  }

  [[nodiscard]] const PairWindow* begin() const noexcept { return windows_; }
  [[nodiscard]] const PairWindow* end() const noexcept { return windows_ + count_; }

 private:
  bool find_new(const Index* corners) noexcept;

  Index offset_[kPairCorners] = {-1};  // of no run: the first one is 0
  Index count_ = 0;
  PairWindow windows_[kPairCorners];
};

}  // namespace hedgerow::kernels
