#include <cmath>
#include <cstring>

#include "binary_value.h"
#include "compose.h"
#include "face_collector.h"
#include "read_context.h"
#include "text_cursor.h"
#include "weld.h"

namespace hedgerow::io {

namespace {

constexpr std::size_t kHeaderBytes = 84;  // 80 of anything, then the count
constexpr std::size_t kRecordBytes = 50;  // normal, three points, two bytes of attributes

Parsed<Soup> read_binary(ReadContext& context) {
  const std::span<const char> bytes = context.bytes;
  if (bytes.size() < kHeaderBytes) {
    return failure(IoErrorCode::unexpected_end, bytes.size(), Place::binary,
                   compose("a binary STL file has at least {} bytes, this one has {}", kHeaderBytes,
                           bytes.size()));
  }
  const std::size_t count = load_little_endian<std::uint32_t>(bytes.data() + 80);
  const std::size_t expected = kHeaderBytes + kRecordBytes * count;
  if (bytes.size() < expected || bytes.size() >= expected + kRecordBytes) {
    return failure(IoErrorCode::size_mismatch, 80, Place::binary,
                   compose("{} triangles are declared, which take {} bytes; the file has {}", count,
                           expected, bytes.size()));
  }
  if (bytes.size() != expected) {
    context.warn("trailing-bytes", expected, Place::binary,
                 compose("{} bytes behind the last triangle", bytes.size() - expected));
  }
  if (count > static_cast<std::size_t>(kMaxCount) / 3) {
    return failure(IoErrorCode::too_many_elements, 80, Place::binary,
                   compose("{} triangles; at most {} can be read", count, kMaxCount / 3));
  }
  Welder welder(3 * count);
  Soup soup;
  soup.corners = Buffer<Index>(3 * count);
  for (std::size_t f = 0; f < count; ++f) {
    const std::size_t points = kHeaderBytes + kRecordBytes * f + 12;
    context.progress.at(points);
    float xyz[9];
    for (std::size_t i = 0; i < 9; ++i) {
      xyz[i] = load_little_endian<float>(bytes.data() + points + 4 * i);
      if (!std::isfinite(xyz[i]) && !context.options.keep_non_finite) {
        return failure(
            IoErrorCode::non_finite, points + 4 * i, Place::binary,
            compose("coordinate {} of corner {} of face {} is {}", "xyz"[i % 3], i / 3, f, xyz[i]));
      }
    }
    for (std::size_t k = 0; k < 3; ++k) soup.corners[3 * f + k] = welder.add(xyz + 3 * k);
  }
  soup.xyz = welder.take_xyz();
  return soup;
}

class AsciiStl {
 public:
  explicit AsciiStl(ReadContext& context)
      : context_(context), cursor_(context.bytes), welder_(context.bytes.size() / 60) {}

  Parsed<Soup> read() {
    cursor_.set_position(cursor_.position() + byte_order_mark_size(context_.bytes));
    if (!read_solids()) return tl::unexpected<Failure>(std::move(failure_));
    Soup soup;
    soup.xyz = welder_.take_xyz();
    faces_.move_into(soup);
    return soup;
  }

 private:
  bool fail(IoErrorCode code, const char* place, std::string message) {
    failure_ = Failure{code, cursor_.offset_of(place), Place::text, std::move(message)};
    return false;
  }

  bool read_solids() {
    bool is_inside = false;
    for (;;) {
      cursor_.skip_space();
      context_.progress.at(cursor_.offset());
      const char* place = cursor_.position();
      if (cursor_.at_end()) break;
      const std::string_view word = cursor_.word();
      if (equals_ignoring_case(word, "facet")) {
        if (!read_facet()) return false;
      } else if (equals_ignoring_case(word, "solid") || equals_ignoring_case(word, "endsolid")) {
        is_inside = word.size() == 5;
        cursor_.skip_line();  // the name may be any text
      } else {
        return fail(IoErrorCode::unexpected_word, place,
                    compose("{} where \"facet\" or \"endsolid\" is required", in_quotes(word)));
      }
    }
    if (is_inside) {
      context_.warn("missing-endsolid", cursor_.offset(), Place::text,
                    "the file ends without \"endsolid\": it may have been cut short");
    }
    return true;
  }

  bool expect(std::string_view wanted) {
    cursor_.skip_space();
    const char* place = cursor_.position();
    if (cursor_.at_end()) return ends_inside();
    const std::string_view word = cursor_.word();
    if (equals_ignoring_case(word, wanted)) return true;
    return fail(IoErrorCode::unexpected_word, place,
                compose("{} where \"{}\" is required", in_quotes(word), wanted));
  }
  bool ends_inside() {
    return fail(IoErrorCode::unexpected_end, cursor_.end(),
                compose("the file ends inside face {}", faces_.face_count()));
  }

  // Behind the last number of its line, which programs have been known to follow by nothing.
  bool expect_line_end(std::string_view what) {
    cursor_.skip_blanks();
    if (cursor_.at_line_end()) return true;
    return fail(IoErrorCode::unexpected_word, cursor_.position(),
                compose("{} behind the {} of face {}", in_quotes(cursor_.peek_word()), what,
                        faces_.face_count()));
  }

  bool read_facet() {
    if (!expect("normal")) return false;
    cursor_.skip_to_line_end();  // computed anew from the points by whoever needs it
    if (!expect("outer") || !expect("loop")) return false;
    std::size_t count = 0;
    const char* loop = cursor_.position();
    for (;;) {
      cursor_.skip_space();
      const char* place = cursor_.position();
      if (cursor_.at_end()) return ends_inside();
      const std::string_view word = cursor_.word();
      if (equals_ignoring_case(word, "endloop")) break;
      if (!equals_ignoring_case(word, "vertex")) {
        return fail(IoErrorCode::unexpected_word, place,
                    compose("{} where \"vertex\" or \"endloop\" is required", in_quotes(word)));
      }
      if (count == 3) return bad_degree(place, "more than 3");
      if (!read_vertex(count++)) return false;
    }
    if (count != 3) return bad_degree(loop, compose("{}", count));
    if (!expect("endfacet")) return false;
    faces_.end_face();
    return !faces_.is_full(3) ||
           fail(IoErrorCode::too_many_elements, loop, compose("more than {} corners", kMaxCount));
  }

  bool bad_degree(const char* place, std::string_view count) {
    return fail(IoErrorCode::bad_face_degree, place,
                compose("the loop of face {} has {} vertices; an STL face has 3",
                        faces_.face_count(), count));
  }

  bool read_vertex(std::size_t corner) {
    float xyz[3] = {};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      cursor_.skip_blanks();
      const char* place = cursor_.position();
      switch (cursor_.read_float(xyz[axis])) {
        case NumberStatus::ok:
          break;
        case NumberStatus::non_finite:
          if (context_.options.keep_non_finite) break;
          return bad_coordinate(IoErrorCode::non_finite, place, axis, corner);
        case NumberStatus::none:
          return fail(IoErrorCode::missing_value, place,
                      compose("corner {} of face {} has {} of 3 coordinates", corner,
                              faces_.face_count(), axis));
        default:
          return bad_coordinate(IoErrorCode::bad_number, place, axis, corner);
      }
    }
    faces_.add_corner(welder_.add(xyz));
    return expect_line_end("coordinates");
  }

  bool bad_coordinate(IoErrorCode code, const char* place, std::size_t axis, std::size_t corner) {
    cursor_.set_position(place);
    return fail(code, place,
                compose("coordinate {} of corner {} of face {} is {}", "xyz"[axis], corner,
                        faces_.face_count(), in_quotes(cursor_.peek_word())));
  }

  ReadContext& context_;
  TextCursor cursor_;
  Welder welder_;
  FaceCollector faces_;
  Failure failure_;
};

bool has_binary_size(std::span<const char> bytes) noexcept {
  if (bytes.size() < kHeaderBytes) return false;
  const std::size_t count = load_little_endian<std::uint32_t>(bytes.data() + 80);
  return bytes.size() == kHeaderBytes + kRecordBytes * count;
}

// "solid" begins many binary headers, too, but those have a byte 0 somewhere.
bool looks_like_text(std::span<const char> bytes) {
  TextCursor cursor(bytes);
  cursor.set_position(cursor.position() + byte_order_mark_size(bytes));
  cursor.skip_space();
  return equals_ignoring_case(cursor.word(), "solid") &&
         std::memchr(bytes.data(), 0, bytes.size()) == nullptr;
}

}  // namespace

Parsed<Soup> read_stl(ReadContext& context) {
  if (has_binary_size(context.bytes) || !looks_like_text(context.bytes)) {
    return read_binary(context);
  }
  return AsciiStl(context).read();
}

}  // namespace hedgerow::io
