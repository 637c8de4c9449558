
#include "compose.h"
#include "ply_mesh.h"
#include "text_cursor.h"

namespace hedgerow::io {

namespace {

class AsciiBody {
 public:
  AsciiBody(const PlyHeader& header, PlyMesh& mesh)
      : header_(header), mesh_(mesh), cursor_(mesh.context().bytes) {
    cursor_.set_position(cursor_.position() + header.body_offset);
  }

  bool read() {
    for (const PlyElement& element : header_.elements) {
      if (!read_element(element)) return false;
    }
    cursor_.skip_space();
    if (!cursor_.at_end()) {
      mesh_.context().warn("trailing-bytes", cursor_.offset(), Place::text,
                           "there is more text behind the last element");
    }
    return true;
  }

 private:
  bool fail(IoErrorCode code, const char* place, std::string message) {
    return mesh_.fail(code, cursor_.offset_of(place), std::move(message));
  }

  bool read_element(const PlyElement& element) {
    if (element.properties.empty()) return true;
    // A record is at least a digit and a separator for each property.
    const auto left = static_cast<std::size_t>(cursor_.end() - cursor_.position());
    const auto count = static_cast<std::size_t>(element.count);
    if (count > (left + 1) / (2 * element.properties.size())) {
      return mesh_.fail(
          IoErrorCode::count_too_large, element.count_offset,
          compose("{} {} records are declared, the {} bytes left hold at most {}", count,
                  in_quotes(element.name), left, (left + 1) / (2 * element.properties.size())));
    }
    if (element.kind == PlyElementKind::vertices) mesh_.xyz() = Buffer<float>(3 * count);
    for (record_ = 0; record_ < count; ++record_) {
      mesh_.context().progress.at(cursor_.offset());
      if (!read_record(element)) return false;
    }
    return true;
  }

  bool read_record(const PlyElement& element) {
    cursor_.skip_space();
    if (cursor_.at_end()) {
      return fail(
          IoErrorCode::unexpected_end, cursor_.end(),
          compose("the file ends before {} {} of {}", element.name, record_, element.count));
    }
    for (const PlyProperty& property : element.properties) {
      cursor_.skip_blanks();
      const bool is_read =
          property.is_list ? read_list(element, property) : read_scalar(element, property);
      if (!is_read) return false;
    }
    cursor_.skip_blanks();
    if (!cursor_.at_line_end()) {
      mesh_.context().warn("extra-values", cursor_.offset(), Place::text,
                           "skipped: values behind the last property of the element");
      cursor_.skip_to_line_end();
    }
    return true;
  }

  bool missing(const PlyElement& element, const PlyProperty& property) {
    return fail(IoErrorCode::missing_value, cursor_.position(),
                compose("the line of {} {} ends before property {}", element.name, record_,
                        in_quotes(property.name)));
  }
  bool bad_number(const PlyElement& element, const PlyProperty& property) {
    return fail(
        IoErrorCode::bad_number, cursor_.position(),
        compose("property {} of {} {} is {}, which is no number of its type",
                in_quotes(property.name), element.name, record_, in_quotes(cursor_.peek_word())));
  }

  bool read_scalar(const PlyElement& element, const PlyProperty& property) {
    if (cursor_.at_line_end()) return missing(element, property);
    if (property.meaning == PlyMeaning::skipped) {
      static_cast<void>(cursor_.word());
      return true;
    }
    const int axis = static_cast<int>(property.meaning) - static_cast<int>(PlyMeaning::x);
    float& value = mesh_.xyz()[3 * record_ + static_cast<std::size_t>(axis)];
    const std::size_t offset = cursor_.offset();
    switch (cursor_.read_float(value)) {
      case NumberStatus::ok:
        return true;
      case NumberStatus::non_finite:
        return mesh_.context().options.keep_non_finite ||
               mesh_.fail_non_finite(record_, axis, static_cast<double>(value), offset);
      default:
        return bad_number(element, property);
    }
  }

  bool read_list(const PlyElement& element, const PlyProperty& property) {
    if (cursor_.at_line_end()) return missing(element, property);
    std::int64_t count = 0;
    const char* place = cursor_.position();
    const NumberStatus status = cursor_.read_integer(count);
    if (status != NumberStatus::ok || !cursor_.at_word_end() || count < 0) {
      cursor_.set_position(place);
      return fail(IoErrorCode::bad_count, place,
                  compose("the count of list {} of {} {} is {}", in_quotes(property.name),
                          element.name, record_, in_quotes(cursor_.peek_word())));
    }
    // No more than the numbers that are there is ever stored, so any count may be tried.
    return read_items(element, property, static_cast<std::size_t>(count));
  }

  bool read_items(const PlyElement& element, const PlyProperty& property, std::size_t count) {
    const bool is_wanted = property.meaning == PlyMeaning::vertex_indices;
    const bool is_strip = is_wanted && element.kind == PlyElementKind::strips;
    const std::size_t start = cursor_.offset();
    if (is_strip) mesh_.start_strips();
    for (std::size_t i = 0; i < count; ++i) {
      cursor_.skip_blanks();
      if (cursor_.at_line_end()) {
        return fail(IoErrorCode::missing_value, cursor_.position(),
                    compose("list {} of {} {} has {} of {} values", in_quotes(property.name),
                            element.name, record_, i, count));
      }
      if (!is_wanted) {
        static_cast<void>(cursor_.word());
        continue;
      }
      if (!read_index(element, property, is_strip)) return false;
    }
    if (!is_wanted || is_strip) return true;
    mesh_.faces().end_face();
    return mesh_.check_room(count, start);
  }

  bool read_index(const PlyElement& element, const PlyProperty& property, bool is_strip) {
    const char* place = cursor_.position();
    std::int64_t index = 0;
    const NumberStatus status = cursor_.read_integer(index);
    if (status == NumberStatus::bad || !cursor_.at_word_end()) {
      cursor_.set_position(place);
      return bad_number(element, property);
    }
    if (status == NumberStatus::too_large) index = std::numeric_limits<std::int64_t>::max();
    const std::size_t offset = cursor_.offset_of(place);
    return is_strip ? mesh_.add_strip_vertex(index, offset) : mesh_.add_corner(index, offset);
  }

  const PlyHeader& header_;
  PlyMesh& mesh_;
  TextCursor cursor_;
  std::size_t record_ = 0;
};

}  // namespace

bool read_ply_ascii_body(const PlyHeader& header, PlyMesh& mesh) {
  return AsciiBody(header, mesh).read();
}

}  // namespace hedgerow::io
