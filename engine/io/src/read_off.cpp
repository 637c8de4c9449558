// OFF as Geomview documents it; one vertex or face a line, which lets colours of any length follow.
#include <limits>

#include "compose.h"
#include "face_collector.h"
#include "off_binary.h"
#include "off_header.h"
#include "read_context.h"
#include "text_cursor.h"

namespace hedgerow::io {

namespace {

class OffReader {
 public:
  OffReader(ReadContext& context, TextCursor cursor) : context_(context), cursor_(cursor) {}

  Parsed<Soup> read() {
    if (!read_counts() || !read_vertices() || !read_faces()) {
      return tl::unexpected<Failure>(std::move(failure_));
    }
    cursor_.skip_space_and_comments();
    if (!cursor_.at_end()) {
      context_.warn("trailing-bytes", cursor_.offset(), Place::text,
                    "there is more text behind the last face");
    }
    Soup soup;
    soup.xyz = std::move(xyz_);
    faces_.move_into(soup);
    return soup;
  }

 private:
  bool fail(IoErrorCode code, const char* place, std::string message) {
    failure_ = Failure{code, cursor_.offset_of(place), Place::text, std::move(message)};
    return false;
  }

  std::string word_at(const char* place) {
    TextCursor at_place = cursor_;
    at_place.set_position(place);
    return in_quotes(at_place.word());
  }

  bool read_counts() {
    constexpr const char* kCounted[] = {"vertices", "faces", "edges"};
    std::int64_t counts[3] = {};
    cursor_.skip_space_and_comments();
    for (int i = 0; i < 3; ++i) {
      const char* place = cursor_.position();
      if (cursor_.ends_before_comment()) {
        return cursor_.at_end() && i == 0 ? fail(IoErrorCode::unexpected_end, cursor_.end(),
                                                 "the file ends before the counts")
                                          : fail(IoErrorCode::missing_value, cursor_.position(),
                                                 compose("{} of the 3 counts on this line", i));
      }
      place = cursor_.position();
      const NumberStatus status = cursor_.read_integer(counts[i]);
      if (status == NumberStatus::bad || !cursor_.at_word_end() || counts[i] < 0) {
        return fail(IoErrorCode::bad_count, place,
                    compose("the number of {} is {}", kCounted[i], word_at(place)));
      }
      // Nobody needs the number of edges, and it is often wrong.
      const auto left = static_cast<std::size_t>(cursor_.end() - cursor_.position());
      const std::size_t most = (left + 1) / (i == 0 ? 6 : 2);
      if (i < 2 &&
          (status == NumberStatus::too_large || static_cast<std::uint64_t>(counts[i]) > most)) {
        return fail(IoErrorCode::count_too_large, place,
                    compose("{} {} are declared, the {} bytes left hold at most {}", word_at(place),
                            kCounted[i], left, most));
      }
      if (counts[i] > kMaxCount && i < 2) {
        return fail(IoErrorCode::too_many_elements, place,
                    compose("{} {}; at most {} can be read", counts[i], kCounted[i], kMaxCount));
      }
    }
    vertex_count_ = counts[0];
    face_count_ = counts[1];
    return true;
  }

  bool read_vertices() {
    xyz_ = Buffer<float>(3 * static_cast<std::size_t>(vertex_count_));
    for (std::int64_t v = 0; v < vertex_count_; ++v) {
      // Counts on the line of the first vertex are no line of their own, either.
      cursor_.skip_space_and_comments();
      context_.progress.at(cursor_.offset());
      if (cursor_.at_end()) {
        return fail(IoErrorCode::unexpected_end, cursor_.end(),
                    compose("the file ends before vertex {} of {}", v, vertex_count_));
      }
      for (int axis = 0; axis < 3; ++axis) {
        if (!read_coordinate(v, axis)) return false;
      }
      cursor_.skip_to_line_end();
    }
    return true;
  }

  bool read_coordinate(std::int64_t v, int axis) {
    if (cursor_.ends_before_comment()) {
      return fail(IoErrorCode::missing_value, cursor_.position(),
                  compose("vertex {} has {} of 3 coordinates", v, axis));
    }
    const char* place = cursor_.position();
    switch (cursor_.read_float(xyz_[static_cast<std::size_t>(3 * v + axis)])) {
      case NumberStatus::ok:
        return true;
      case NumberStatus::non_finite:
        return context_.options.keep_non_finite ||
               fail(IoErrorCode::non_finite, place,
                    compose("coordinate {} of vertex {} is {}", "xyz"[axis], v, word_at(place)));
      default:
        return fail(IoErrorCode::bad_number, place,
                    compose("coordinate {} of vertex {} is {}, which is no number", "xyz"[axis], v,
                            word_at(place)));
    }
  }

  bool read_faces() {
    for (std::int64_t f = 0; f < face_count_; ++f) {
      cursor_.skip_space_and_comments();
      context_.progress.at(cursor_.offset());
      if (cursor_.at_end()) {
        return fail(IoErrorCode::unexpected_end, cursor_.end(),
                    compose("the file ends before face {} of {}", f, face_count_));
      }
      if (!read_face(f)) return false;
      cursor_.skip_to_line_end();
    }
    return true;
  }

  bool read_face(std::int64_t f) {
    const char* place = cursor_.position();
    std::int64_t degree = 0;
    const NumberStatus status = cursor_.read_integer(degree);
    if (status == NumberStatus::bad || !cursor_.at_word_end()) {
      return fail(IoErrorCode::bad_number, place,
                  compose("the number of corners of face {} is {}", f, word_at(place)));
    }
    if (degree < 0) {
      return fail(IoErrorCode::bad_face_degree, place,
                  compose("face {} has {} corners", f, degree));
    }
    // No more than the numbers that are there is ever stored, so any count may be tried.
    if (status == NumberStatus::too_large) degree = std::numeric_limits<std::int64_t>::max();
    for (std::int64_t k = 0; k < degree; ++k) {
      if (!read_corner(f, k, degree)) return false;
    }
    faces_.end_face();
    return !faces_.is_full(static_cast<std::size_t>(degree)) ||
           fail(IoErrorCode::too_many_elements, place,
                compose("more than {} faces or corners", kMaxCount));
  }

  bool read_corner(std::int64_t f, std::int64_t k, std::int64_t degree) {
    if (cursor_.ends_before_comment()) {
      return fail(IoErrorCode::missing_value, cursor_.position(),
                  compose("face {} has {} of {} corners", f, k, degree));
    }
    const char* place = cursor_.position();
    std::int64_t index = 0;
    const NumberStatus status = cursor_.read_integer(index);
    if (status == NumberStatus::bad || !cursor_.at_word_end()) {
      return fail(IoErrorCode::bad_number, place,
                  compose("corner {} of face {} is {}, which is no index", k, f, word_at(place)));
    }
    const bool is_too_large = status == NumberStatus::too_large;
    if ((is_too_large || index < 0 || index >= vertex_count_) &&
        !context_.options.keep_out_of_range) {
      return fail(IoErrorCode::index_out_of_range, place,
                  compose("face {} refers to vertex {}, the file has {}", f,
                          is_too_large ? word_at(place) : compose("{}", index), vertex_count_));
    }
    const bool fits =
        !is_too_large && index <= kMaxCount && index >= std::numeric_limits<Index>::min();
    faces_.add_corner(fits ? static_cast<Index>(index) : kInvalidIndex);
    return true;
  }

  ReadContext& context_;
  TextCursor cursor_;
  Buffer<float> xyz_;
  FaceCollector faces_;
  std::int64_t vertex_count_ = 0;
  std::int64_t face_count_ = 0;
  Failure failure_;
};

}  // namespace

Parsed<Soup> read_off(ReadContext& context) {
  TextCursor cursor(context.bytes);
  cursor.set_position(cursor.position() + byte_order_mark_size(context.bytes));
  const Parsed<OffVariant> variant = read_off_keyword(cursor);
  if (variant && variant->is_binary) return read_off_binary(context, *variant, cursor.offset());
  if (std::optional<Failure> failed = check_is_text(context.bytes)) {
    return tl::unexpected<Failure>(std::move(*failed));
  }
  if (!variant) return tl::unexpected<Failure>(variant.error());
  return OffReader(context, cursor).read();
}

}  // namespace hedgerow::io
