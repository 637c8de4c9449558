#pragma once

#include <limits>
#include <utility>

#include "compose.h"
#include "face_collector.h"
#include "ply_header.h"
#include "read_context.h"
#include "strips.h"

namespace hedgerow::io {

/// The mesh that a PLY body is read into; what the ascii and the binary reader have in common.
class PlyMesh {
 public:
  PlyMesh(ReadContext& context, const PlyHeader& header, Place place)
      : vertex_count_(header.vertex_count), context_(context), place_(place), strips_(faces_) {}
  PlyMesh(const PlyMesh&) = delete;
  PlyMesh& operator=(const PlyMesh&) = delete;

  [[nodiscard]] ReadContext& context() noexcept { return context_; }
  [[nodiscard]] FaceCollector& faces() noexcept { return faces_; }
  [[nodiscard]] Buffer<float>& xyz() noexcept { return xyz_; }
  [[nodiscard]] Failure take_failure() { return std::move(failure_); }
  [[nodiscard]] Soup take_soup() {
    Soup soup;
    soup.xyz = std::move(xyz_);
    faces_.move_into(soup);
    return soup;
  }

  bool fail(IoErrorCode code, std::size_t offset, std::string message) {
    failure_ = Failure{code, offset, place_, std::move(message)};
    return false;
  }

  /// The index as it is stored; refused where no such vertex exists, unless that is allowed.
  bool check_index(std::int64_t index, std::size_t offset, Index& vertex) {
    if (index >= 0 && index < vertex_count_) {
      vertex = static_cast<Index>(index);
      return true;
    }
    if (!context_.options.keep_out_of_range) {
      return fail(IoErrorCode::index_out_of_range, offset,
                  compose("face {} refers to vertex {}, the file has {}", faces_.face_count(),
                          index, vertex_count_));
    }
    const bool fits = index <= kMaxCount && index >= std::numeric_limits<Index>::min();
    vertex = fits ? static_cast<Index>(index) : kInvalidIndex;
    return true;
  }
  bool add_corner(std::int64_t index, std::size_t offset) {
    Index vertex = kInvalidIndex;
    if (!check_index(index, offset, vertex)) return false;
    faces_.add_corner(vertex);
    return true;
  }
  bool add_strip_vertex(std::int64_t index, std::size_t offset) {
    if (index == -1) {
      strips_.restart();
      return true;
    }
    Index vertex = kInvalidIndex;
    if (!check_index(index, offset, vertex)) return false;
    strips_.add(vertex);
    return check_room(3, offset);
  }
  void start_strips() noexcept { strips_.restart(); }
  bool check_room(std::size_t degree, std::size_t offset) {
    if (!faces_.is_full(degree)) return true;
    return fail(IoErrorCode::too_many_elements, offset,
                compose("more than {} faces or corners", kMaxCount));
  }
  bool fail_non_finite(std::size_t vertex, int axis, double value, std::size_t offset) {
    return fail(IoErrorCode::non_finite, offset,
                compose("coordinate {} of vertex {} is {}", "xyz"[axis], vertex, value));
  }

 private:
  Buffer<float> xyz_;
  FaceCollector faces_;
  std::int64_t vertex_count_;
  ReadContext& context_;
  Place place_;
  StripDecoder strips_;
  Failure failure_;
};

/// Read everything behind the header. False: `mesh.take_failure()` has the reason.
[[nodiscard]] bool read_ply_ascii_body(const PlyHeader& header, PlyMesh& mesh);
[[nodiscard]] bool read_ply_binary_body(const PlyHeader& header, PlyMesh& mesh);

}  // namespace hedgerow::io
