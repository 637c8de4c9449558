#pragma once

#include "face_collector.h"
#include "hedgerow/index.h"

namespace hedgerow::io {

/// Cuts triangle strips into triangles that all have the winding of the first: every second one of
/// a strip is turned round. A triangle that repeats a vertex only carries the strip over to its
/// next part; it is dropped, and counts for the alternation.
class StripDecoder {
 public:
  explicit StripDecoder(FaceCollector& faces) : faces_(faces) {}

  void restart() noexcept { count_ = 0; }
  void add(Index vertex) {
    if (count_ >= 2 && vertex != last_ && vertex != before_last_ && last_ != before_last_) {
      const bool is_turned = count_ % 2 == 1;
      faces_.add_corner(is_turned ? last_ : before_last_);
      faces_.add_corner(is_turned ? before_last_ : last_);
      faces_.add_corner(vertex);
      faces_.end_face();
    }
    before_last_ = last_;
    last_ = vertex;
    ++count_;
  }

 private:
  FaceCollector& faces_;
  Index before_last_ = kInvalidIndex;
  Index last_ = kInvalidIndex;
  std::size_t count_ = 0;  ///< vertices of this strip so far
};

}  // namespace hedgerow::io
