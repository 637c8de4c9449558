#pragma once

#include <cstddef>
#include <utility>

#include "grow_buffer.h"
#include "hedgerow/index.h"
#include "hedgerow/soup.h"

namespace hedgerow::io {

/// Gathers faces corner by corner. Offsets are kept only from the first face on that is no
/// triangle, so that a triangle file costs its corners and nothing else.
class FaceCollector {
 public:
  void add_corner(Index vertex) { corners_.push(vertex); }
  /// Room for the corners of one face; `end_face` must follow.
  [[nodiscard]] Index* add_corners(std::size_t count) { return corners_.append(count); }
  void end_face() {
    const std::size_t degree = corners_.size() - face_start_;
    face_start_ = corners_.size();
    if (degree != 3 && !is_mixed_) start_offsets();
    ++face_count_;
    if (is_mixed_) offsets_.push(static_cast<Index>(face_start_));
  }
  /// Reserves for `corner_count` corners. \pre nothing was added yet.
  void reserve(std::size_t corner_count) { corners_ = GrowBuffer<Index>(corner_count); }

  [[nodiscard]] std::size_t face_count() const noexcept { return face_count_; }
  [[nodiscard]] std::size_t corner_count() const noexcept { return corners_.size(); }
  /// True if an `Index` cannot number the corners and faces, give or take one face of `degree`.
  [[nodiscard]] bool is_full(std::size_t degree) const noexcept {
    return degree > static_cast<std::size_t>(kMaxCount) ||
           corners_.size() > static_cast<std::size_t>(kMaxCount) - degree ||
           face_count_ >= static_cast<std::size_t>(kMaxCount);
  }

  void move_into(Soup& soup) {
    soup.corners = corners_.take();
    soup.offsets = is_mixed_ ? offsets_.take() : Buffer<Index>();
  }

 private:
  void start_offsets() {
    is_mixed_ = true;
    Index* offsets = offsets_.append(face_count_ + 1);
    for (std::size_t f = 0; f <= face_count_; ++f) offsets[f] = static_cast<Index>(3 * f);
  }

  GrowBuffer<Index> corners_;
  GrowBuffer<Index> offsets_;
  std::size_t face_start_ = 0;
  std::size_t face_count_ = 0;
  bool is_mixed_ = false;
};

}  // namespace hedgerow::io
