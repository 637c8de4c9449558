// OFF BINARY: the standard (Geomview) has big-endian values and a colour count behind each face;
// files of the PMP library have this machine's byte order and no colours. Nothing in the file says
// which, but the records must end where the file ends, and of the four readings hardly ever more
// than one does.
#include "off_binary.h"

#include <bit>
#include <cmath>
#include <limits>

#include "binary_value.h"
#include "compose.h"
#include "face_collector.h"

namespace hedgerow::io {

namespace {

struct Dialect {
  std::endian order;
  bool has_face_colours;
};
constexpr Dialect kDialects[] = {{std::endian::big, true},
                                 {std::endian::big, false},
                                 {std::endian::little, true},
                                 {std::endian::little, false}};

class BinaryOff {
 public:
  BinaryOff(ReadContext& context, const OffVariant& variant, std::size_t body, Dialect dialect)
      : context_(context), bytes_(context.bytes), at_(body), dialect_(dialect) {
    vertex_bytes_ = 4 * variant.floats_per_vertex();
  }

  // Walks the records without storing anything.
  [[nodiscard]] bool ends_with_the_file() {
    const std::size_t body = at_;
    bool fits = read_counts().has_value();
    if (fits) {
      at_ += vertex_count_ * vertex_bytes_;
      for (std::size_t f = 0; f < face_count_ && fits; ++f) fits = skip_face();
    }
    fits = fits && at_ == bytes_.size();
    at_ = body;
    return fits;
  }

  Parsed<Soup> read() {
    if (const Parsed<void> counts = read_counts(); !counts) {
      return tl::unexpected<Failure>(counts.error());
    }
    Soup soup;
    soup.xyz = Buffer<float>(3 * vertex_count_);
    for (std::size_t v = 0; v < vertex_count_; ++v, at_ += vertex_bytes_) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const float value = std::bit_cast<float>(word_at(at_ + 4 * axis));
        soup.xyz[3 * v + axis] = value;
        if (!std::isfinite(value) && !context_.options.keep_non_finite) {
          return fail(IoErrorCode::non_finite, at_ + 4 * axis,
                      compose("coordinate {} of vertex {} is {}", "xyz"[axis], v, value));
        }
      }
    }
    for (std::size_t f = 0; f < face_count_; ++f) {
      context_.progress.at(at_);
      if (const Parsed<void> face = read_face(); !face) {
        return tl::unexpected<Failure>(face.error());
      }
    }
    if (at_ != bytes_.size()) {
      context_.warn("trailing-bytes", at_, Place::binary,
                    compose("{} bytes behind the last face", bytes_.size() - at_));
    }
    faces_.move_into(soup);
    return soup;
  }

 private:
  [[nodiscard]] std::size_t left() const noexcept { return bytes_.size() - at_; }
  [[nodiscard]] std::uint32_t word_at(std::size_t at) const noexcept {
    return dialect_.order == std::endian::native ? load<std::uint32_t, false>(bytes_.data() + at)
                                                 : load<std::uint32_t, true>(bytes_.data() + at);
  }
  static tl::unexpected<Failure> fail(IoErrorCode code, std::size_t offset, std::string message) {
    return failure(code, offset, Place::binary, std::move(message));
  }

  Parsed<void> read_counts() {
    if (left() < 12) {
      return fail(IoErrorCode::unexpected_end, at_, "the file ends inside the three counts");
    }
    vertex_count_ = word_at(at_);
    face_count_ = word_at(at_ + 4);
    if (vertex_count_ > (left() - 12) / vertex_bytes_ ||
        face_count_ > (left() - 12 - vertex_count_ * vertex_bytes_) / smallest_face_bytes()) {
      return fail(IoErrorCode::count_too_large, at_,
                  compose("{} vertices and {} faces are declared, {} bytes follow", vertex_count_,
                          face_count_, left() - 12));
    }
    if (vertex_count_ > static_cast<std::uint64_t>(kMaxCount)) {
      return fail(IoErrorCode::too_many_elements, at_,
                  compose("{} vertices; at most {} can be read", vertex_count_, kMaxCount));
    }
    at_ += 12;
    return {};
  }
  [[nodiscard]] std::size_t smallest_face_bytes() const noexcept {
    return dialect_.has_face_colours ? 8 : 4;
  }

  // Over the count at the cursor and as many values; false: the file ends first.
  bool skip_values() noexcept {
    if (left() < 4) return false;
    const std::size_t count = word_at(at_);
    if (count > (left() - 4) / 4) return false;
    at_ += 4 + 4 * count;
    return true;
  }
  bool skip_face() noexcept {
    return skip_values() && (!dialect_.has_face_colours || skip_values());
  }

  Parsed<void> read_face() {
    const std::size_t start = at_;
    if (!skip_face()) {
      return fail(IoErrorCode::unexpected_end, start,
                  compose("the file ends inside face {} of {}", faces_.face_count(), face_count_));
    }
    const std::size_t degree = word_at(start);
    for (std::size_t k = 0; k < degree; ++k) {
      const std::size_t place = start + 4 + 4 * k;
      const auto index = static_cast<std::int32_t>(word_at(place));
      const bool exists = index >= 0 && static_cast<std::size_t>(index) < vertex_count_;
      if (!exists && !context_.options.keep_out_of_range) {
        return fail(IoErrorCode::index_out_of_range, place,
                    compose("face {} refers to vertex {}, the file has {}", faces_.face_count(),
                            index, vertex_count_));
      }
      faces_.add_corner(index);
    }
    faces_.end_face();
    if (faces_.is_full(degree)) {
      return fail(IoErrorCode::too_many_elements, start,
                  compose("more than {} faces or corners", kMaxCount));
    }
    return {};
  }

  ReadContext& context_;
  std::span<const char> bytes_;
  std::size_t at_;
  Dialect dialect_;
  std::size_t vertex_bytes_ = 0;
  std::size_t vertex_count_ = 0;
  std::size_t face_count_ = 0;
  FaceCollector faces_;
};

}  // namespace

Parsed<Soup> read_off_binary(ReadContext& context, const OffVariant& variant,
                             std::size_t body_offset) {
  for (const Dialect dialect : kDialects) {
    if (BinaryOff(context, variant, body_offset, dialect).ends_with_the_file()) {
      return BinaryOff(context, variant, body_offset, dialect).read();
    }
  }
  // Damaged in any reading: report what is wrong in the order in which the counts make sense.
  Parsed<Soup> big = BinaryOff(context, variant, body_offset, {std::endian::big, true}).read();
  if (!big && big.error().code == IoErrorCode::count_too_large) {
    return BinaryOff(context, variant, body_offset, {std::endian::little, false}).read();
  }
  return big;
}

}  // namespace hedgerow::io
