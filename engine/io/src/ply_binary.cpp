#include <bit>
#include <cmath>
#include <cstring>

#include "binary_value.h"
#include "compose.h"
#include "ply_mesh.h"
#include "text_cursor.h"

namespace hedgerow::io {

namespace {

// Integers only; a PLY list never has a wider count than 32 bits.
template <bool kSwap>
std::int64_t scalar_as_integer(const char* from, PlyType type) noexcept {
  switch (type) {
    case PlyType::i8:
      return load<std::int8_t, kSwap>(from);
    case PlyType::u8:
      return load<std::uint8_t, kSwap>(from);
    case PlyType::i16:
      return load<std::int16_t, kSwap>(from);
    case PlyType::u16:
      return load<std::uint16_t, kSwap>(from);
    case PlyType::u32:
      return load<std::uint32_t, kSwap>(from);
    default:
      return load<std::int32_t, kSwap>(from);
  }
}

template <bool kSwap>
double scalar_as_double(const char* from, PlyType type) noexcept {
  if (type == PlyType::f32) return static_cast<double>(load<float, kSwap>(from));
  if (type == PlyType::f64) return load<double, kSwap>(from);
  return static_cast<double>(scalar_as_integer<kSwap>(from, type));
}

template <bool kSwap>
class BinaryBody {
 public:
  BinaryBody(const PlyHeader& header, PlyMesh& mesh)
      : header_(header),
        mesh_(mesh),
        begin_(mesh.context().bytes.data()),
        position_(begin_ + header.body_offset),
        end_(begin_ + mesh.context().bytes.size()) {}

  bool read() {
    for (const PlyElement& element : header_.elements) {
      if (!read_element(element)) return false;
    }
    if (position_ != end_) {
      mesh_.context().warn("trailing-bytes", offset(), Place::binary,
                           compose("{} bytes behind the last element", end_ - position_));
    }
    return true;
  }

 private:
  [[nodiscard]] std::size_t offset() const noexcept {
    return static_cast<std::size_t>(position_ - begin_);
  }
  [[nodiscard]] std::size_t left() const noexcept {
    return static_cast<std::size_t>(end_ - position_);
  }

  bool read_element(const PlyElement& element) {
    const std::size_t record_bytes = element.smallest_record_bytes();
    if (record_bytes == 0) return true;
    const auto count = static_cast<std::size_t>(element.count);
    if (count > left() / record_bytes) {
      return mesh_.fail(
          IoErrorCode::count_too_large, offset(),
          compose("{} {} records of at least {} bytes are declared, the {} bytes left hold {}",
                  count, in_quotes(element.name), record_bytes, left(), left() / record_bytes));
    }
    if (element.kind == PlyElementKind::vertices) mesh_.xyz() = Buffer<float>(3 * count);
    if (!element.has_lists()) return read_fixed(element, count, record_bytes);
    if (is_plain_triangle_list(element)) return read_plain_faces(element, count);
    for (record_ = 0; record_ < count; ++record_) {
      mesh_.context().progress.at(offset());
      if (!read_record(element)) return false;
    }
    return true;
  }

  // Records of one size: each coordinate has its own stride through them.
  bool read_fixed(const PlyElement& element, std::size_t count, std::size_t record_bytes) {
    const char* records = position_;
    position_ += count * record_bytes;
    if (element.kind != PlyElementKind::vertices) return true;
    std::size_t at = 0;
    for (const PlyProperty& property : element.properties) {
      if (property.meaning != PlyMeaning::skipped &&
          !read_axis(property, records + at, count, record_bytes)) {
        return false;
      }
      at += size_bytes(property.type);
    }
    return true;
  }

  bool read_axis(const PlyProperty& property, const char* from, std::size_t count,
                 std::size_t stride) {
    const int axis = axis_of(property);
    float* to = mesh_.xyz().data() + axis;
    // One finite check for the column: the sum of x - x is NaN if any x is not finite.
    float check = 0;
    if (property.type == PlyType::f32) {
      for (std::size_t i = 0; i < count; ++i) {
        const float value = load<float, kSwap>(from + i * stride);
        to[3 * i] = value;
        check += value - value;
      }
    } else {
      for (std::size_t i = 0; i < count; ++i) {
        const auto value =
            static_cast<float>(scalar_as_double<kSwap>(from + i * stride, property.type));
        to[3 * i] = value;
        check += value - value;
      }
    }
    if (!std::isnan(check) || mesh_.context().options.keep_non_finite) return true;
    std::size_t i = 0;
    while (std::isfinite(to[3 * i])) ++i;
    return mesh_.fail_non_finite(i, axis, scalar_as_double<kSwap>(from + i * stride, property.type),
                                 static_cast<std::size_t>(from + i * stride - begin_));
  }

  static int axis_of(const PlyProperty& property) noexcept {
    return static_cast<int>(property.meaning) - static_cast<int>(PlyMeaning::x);
  }

  // "list uchar int" and nothing else: nearly every file there is, so it has a loop of its own.
  static bool is_plain_triangle_list(const PlyElement& element) noexcept {
    if (element.kind != PlyElementKind::faces || element.properties.size() != 1) return false;
    const PlyProperty& list = element.properties[0];
    return list.count_type == PlyType::u8 &&
           (list.type == PlyType::i32 || list.type == PlyType::u32);
  }

  bool read_plain_faces(const PlyElement& element, std::size_t count) {
    mesh_.faces().reserve(std::min(3 * count, left() / 4));
    // As unsigned, a negative index is beyond every count.
    const auto vertex_count = static_cast<std::uint64_t>(header_.vertex_count);
    for (record_ = 0; record_ < count; ++record_) {
      if (record_ % 65536 == 0) mesh_.context().progress.at(offset());
      if (left() >= 13 && *position_ == 3) {
        const auto a = load<std::uint32_t, kSwap>(position_ + 1);
        const auto b = load<std::uint32_t, kSwap>(position_ + 5);
        const auto c = load<std::uint32_t, kSwap>(position_ + 9);
        if (a < vertex_count && b < vertex_count && c < vertex_count && !mesh_.faces().is_full(3)) {
          Index* corners = mesh_.faces().add_corners(3);
          corners[0] = static_cast<Index>(a);
          corners[1] = static_cast<Index>(b);
          corners[2] = static_cast<Index>(c);
          mesh_.faces().end_face();
          position_ += 13;
          continue;
        }
      }
      if (!read_record(element)) return false;
    }
    return true;
  }

  bool read_record(const PlyElement& element) {
    for (const PlyProperty& property : element.properties) {
      if (property.is_list ? !read_list(element, property) : !read_scalar(element, property)) {
        return false;
      }
    }
    return true;
  }

  bool ends_inside(const PlyElement& element) {
    return mesh_.fail(
        IoErrorCode::unexpected_end, offset(),
        compose("the file ends inside {} {} of {}", element.name, record_, element.count));
  }

  bool read_scalar(const PlyElement& element, const PlyProperty& property) {
    const std::size_t bytes = size_bytes(property.type);
    if (left() < bytes) return ends_inside(element);
    if (property.meaning != PlyMeaning::skipped) {
      const int axis = axis_of(property);
      const double value = scalar_as_double<kSwap>(position_, property.type);
      const auto as_float = static_cast<float>(value);
      mesh_.xyz()[3 * record_ + static_cast<std::size_t>(axis)] = as_float;
      if (!std::isfinite(as_float) && !mesh_.context().options.keep_non_finite) {
        return mesh_.fail_non_finite(record_, axis, value, offset());
      }
    }
    position_ += bytes;
    return true;
  }

  bool read_list(const PlyElement& element, const PlyProperty& property) {
    const std::size_t count_bytes = size_bytes(property.count_type);
    if (left() < count_bytes) return ends_inside(element);
    const std::int64_t declared = scalar_as_integer<kSwap>(position_, property.count_type);
    if (declared < 0) {
      return mesh_.fail(IoErrorCode::bad_count, offset(),
                        compose("the count of list {} of {} {} is {}", in_quotes(property.name),
                                element.name, record_, declared));
    }
    const auto count = static_cast<std::size_t>(declared);
    const std::size_t item_bytes = size_bytes(property.type);
    if (count > (left() - count_bytes) / item_bytes) {
      return mesh_.fail(IoErrorCode::unexpected_end, offset(),
                        compose("list {} of {} {} has a count of {}, the {} bytes left hold {}",
                                in_quotes(property.name), element.name, record_, count,
                                left() - count_bytes, (left() - count_bytes) / item_bytes));
    }
    position_ += count_bytes;
    if (property.meaning != PlyMeaning::vertex_indices) {
      position_ += count * item_bytes;
      return true;
    }
    return read_indices(element, property, count);
  }

  bool read_indices(const PlyElement& element, const PlyProperty& property, std::size_t count) {
    const std::size_t item_bytes = size_bytes(property.type);
    const bool is_strip = element.kind == PlyElementKind::strips;
    if (is_strip) mesh_.start_strips();
    for (std::size_t i = 0; i < count; ++i, position_ += item_bytes) {
      const std::int64_t index = scalar_as_integer<kSwap>(position_, property.type);
      if (is_strip ? !mesh_.add_strip_vertex(index, offset())
                   : !mesh_.add_corner(index, offset())) {
        return false;
      }
    }
    if (is_strip) return true;
    mesh_.faces().end_face();
    return mesh_.check_room(count, offset());
  }

  const PlyHeader& header_;
  PlyMesh& mesh_;
  const char* begin_;
  const char* position_;
  const char* end_;
  std::size_t record_ = 0;
};

}  // namespace

bool read_ply_binary_body(const PlyHeader& header, PlyMesh& mesh) {
  const bool is_little = header.format == PlyFormat::binary_little_endian;
  return is_little == (std::endian::native == std::endian::little)
             ? BinaryBody<false>(header, mesh).read()
             : BinaryBody<true>(header, mesh).read();
}

}  // namespace hedgerow::io
