// The PLY polygon file format, Greg Turk 1994; type names of both spellings in use.
#include "ply_header.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "compose.h"
#include "hedgerow/index.h"
#include "text_cursor.h"

namespace hedgerow::io {

namespace {

struct TypeName {
  std::string_view name;
  PlyType type;
};
constexpr TypeName kTypeNames[] = {
    {"char", PlyType::i8},    {"int8", PlyType::i8},     {"uchar", PlyType::u8},
    {"uint8", PlyType::u8},   {"short", PlyType::i16},   {"int16", PlyType::i16},
    {"ushort", PlyType::u16}, {"uint16", PlyType::u16},  {"int", PlyType::i32},
    {"int32", PlyType::i32},  {"uint", PlyType::u32},    {"uint32", PlyType::u32},
    {"float", PlyType::f32},  {"float32", PlyType::f32}, {"double", PlyType::f64},
    {"float64", PlyType::f64}};

constexpr std::size_t kLongestLine = 1 << 16;  // of a header; more is not one

class HeaderReader {
 public:
  explicit HeaderReader(std::span<const char> bytes) : bytes_(bytes), cursor_(bytes) {}

  Parsed<PlyHeader> read() {
    if (!read_magic() || !read_lines() || !assign_meanings()) {
      return tl::unexpected<Failure>(std::move(failure_));
    }
    return std::move(header_);
  }

 private:
  bool fail_at(IoErrorCode code, std::size_t offset, std::string message) {
    failure_ = Failure{code, offset, Place::text, std::move(message)};
    return false;
  }
  bool fail(IoErrorCode code, const char* place, std::string message) {
    return fail_at(code, cursor_.offset_of(place), std::move(message));
  }

  // The first line decides how lines end: behind "end_header\r" a byte 10 may be data.
  bool read_magic() {
    cursor_.set_position(cursor_.position() + byte_order_mark_size(bytes_));
    const char* start = cursor_.position();
    const std::string_view word = cursor_.peek_word();
    if (word != "ply") {
      return fail(IoErrorCode::bad_header, start,
                  "the file begins with " + in_quotes(word) + " instead of \"ply\"");
    }
    cursor_.set_position(start + 3);
    cursor_.skip_blanks();
    if (!cursor_.at_line_end() || cursor_.at_end()) {
      return fail(IoErrorCode::bad_header, cursor_.position(),
                  "\"ply\" must stand on a line alone");
    }
    const char* line_end = cursor_.position();
    cursor_.skip_line_end();
    ends_with_cr_alone_ = *line_end == '\r' && cursor_.position() - line_end == 1;
    return true;
  }

  void skip_line_end() {
    if (ends_with_cr_alone_ && cursor_.at('\r')) {
      cursor_.step();
    } else {
      cursor_.skip_line_end();
    }
  }

  bool read_lines() {
    for (;;) {
      if (cursor_.at_end()) {
        return fail(IoErrorCode::unexpected_end, cursor_.end(),
                    "the file ends inside the header: there is no \"end_header\"");
      }
      cursor_.skip_blanks();
      const char* start = cursor_.position();
      const std::string_view word = cursor_.word();
      if (word.size() > kLongestLine) return unknown_line(start, word);
      if (word == "end_header") {
        cursor_.skip_blanks();
        if (!expect_line_end("end_header")) return false;
        skip_line_end();
        header_.body_offset = cursor_.offset();
        if (!has_format_) {
          return fail(IoErrorCode::bad_header, start, "the header has no \"format\" line");
        }
        return true;
      }
      if (!read_line(word, start)) return false;
      skip_line_end();
    }
  }

  bool read_line(std::string_view word, const char* start) {
    if (word == "comment" || word == "obj_info" || word.empty()) {
      cursor_.skip_to_line_end();
      return true;
    }
    cursor_.skip_blanks();
    if (word == "format") return read_format();
    if (word == "element") return read_element();
    if (word == "property") return read_property(start);
    return unknown_line(start, word);
  }

  bool unknown_line(const char* start, std::string_view word) {
    return fail(IoErrorCode::bad_header, start,
                in_quotes(word) + " begins no line of a PLY header");
  }

  bool expect_line_end(std::string_view what) {
    cursor_.skip_blanks();
    if (cursor_.at_line_end()) return true;
    return fail(IoErrorCode::bad_header, cursor_.position(),
                compose("{} behind the {}", in_quotes(cursor_.peek_word()), what));
  }

  bool read_format() {
    const char* place = cursor_.position();
    const std::string_view word = cursor_.word();
    if (word == "ascii") {
      header_.format = PlyFormat::ascii;
    } else if (word == "binary_little_endian") {
      header_.format = PlyFormat::binary_little_endian;
    } else if (word == "binary_big_endian") {
      header_.format = PlyFormat::binary_big_endian;
    } else {
      return fail(IoErrorCode::unsupported_variant, place,
                  "the format is " + in_quotes(word) +
                      ", not ascii, binary_little_endian or binary_big_endian");
    }
    cursor_.skip_blanks();
    place = cursor_.position();
    const std::string_view version = cursor_.word();
    if (version != "1.0") {
      return fail(IoErrorCode::unsupported_variant, place,
                  "the version is " + in_quotes(version) + ", not 1.0");
    }
    has_format_ = true;
    return expect_line_end("format");
  }

  bool read_element() {
    PlyElement element;
    element.name = cursor_.word();
    cursor_.skip_blanks();
    const char* place = cursor_.position();
    element.count_offset = cursor_.offset();
    const NumberStatus status = cursor_.read_integer(element.count);
    if (status == NumberStatus::none || element.name.empty()) {
      return fail(IoErrorCode::missing_value, place, "an element needs a name and a count");
    }
    if (status == NumberStatus::bad || element.count < 0 || !cursor_.at_word_end()) {
      cursor_.set_position(place);
      return fail(IoErrorCode::bad_count, place,
                  compose("the count of element {} is {}", in_quotes(element.name),
                          in_quotes(cursor_.peek_word())));
    }
    const bool is_too_large = status == NumberStatus::too_large;
    if (is_too_large || static_cast<std::uint64_t>(element.count) > bytes_.size() * 8) {
      cursor_.set_position(place);
      return fail(
          IoErrorCode::count_too_large, place,
          compose("element {} has a count of {} in a file of {} bytes", in_quotes(element.name),
                  cursor_.peek_word().substr(0, 40), bytes_.size()));
    }
    for (const PlyElement& other : header_.elements) {
      if (other.name == element.name) {
        return fail(IoErrorCode::bad_header, place,
                    compose("a second element {}", in_quotes(element.name)));
      }
    }
    header_.elements.push_back(std::move(element));
    return expect_line_end("element");
  }

  bool read_type(PlyType& type) {
    cursor_.skip_blanks();
    const char* place = cursor_.position();
    const std::string_view word = cursor_.word();
    for (const TypeName& known : kTypeNames) {
      if (word == known.name) {
        type = known.type;
        return true;
      }
    }
    return fail(IoErrorCode::unknown_type, place,
                in_quotes(word) + " is no type of a PLY property");
  }

  bool read_property(const char* start) {
    if (header_.elements.empty()) {
      return fail(IoErrorCode::bad_header, start, "a property before the first element");
    }
    PlyProperty property;
    property.is_list = cursor_.peek_word() == "list";
    if (property.is_list) {
      static_cast<void>(cursor_.word());
      cursor_.skip_blanks();
      const char* place = cursor_.position();
      if (!read_type(property.count_type)) return false;
      if (!is_integer(property.count_type)) {
        return fail(IoErrorCode::bad_property, place, "the count of a list must be an integer");
      }
    }
    if (!read_type(property.type)) return false;
    cursor_.skip_blanks();
    const char* place = cursor_.position();
    property.name = cursor_.word();
    if (property.name.empty()) {
      return fail(IoErrorCode::missing_value, place, "a property needs a name");
    }
    PlyElement& element = header_.elements.back();
    for (const PlyProperty& other : element.properties) {
      if (other.name == property.name) {
        return fail(IoErrorCode::duplicate_property, place,
                    compose("element {} has two properties {}", in_quotes(element.name),
                            in_quotes(property.name)));
      }
    }
    element.properties.push_back(property);
    return expect_line_end("property");
  }

  bool assign_meanings() {
    bool has_vertices = false;
    bool has_faces = false;
    for (PlyElement& element : header_.elements) {
      if (element.name == "vertex") {
        has_vertices = true;
        if (!mark_vertices(element)) return false;
      } else if (element.name == "face" && element.count > 0) {
        has_faces = true;
        if (!mark_faces(element, PlyElementKind::faces)) return false;
      }
    }
    if (!has_vertices) {
      return fail_at(IoErrorCode::missing_element, header_.body_offset,
                     "the header declares no element \"vertex\"");
    }
    for (PlyElement& element : header_.elements) {
      if (element.name == "tristrips" && !has_faces &&
          !mark_faces(element, PlyElementKind::strips)) {
        return false;
      }
    }
    return true;
  }

  bool mark_vertices(PlyElement& element) {
    constexpr std::pair<std::string_view, PlyMeaning> kAxes[] = {
        {"x", PlyMeaning::x}, {"y", PlyMeaning::y}, {"z", PlyMeaning::z}};
    for (const auto& [name, meaning] : kAxes) {
      const std::string_view wanted = name;
      const auto found = std::ranges::find(element.properties, wanted, &PlyProperty::name);
      if (found == element.properties.end()) {
        return fail_at(IoErrorCode::missing_property, element.count_offset,
                       compose("element \"vertex\" has no property \"{}\"", wanted));
      }
      if (found->is_list) {
        return fail_at(IoErrorCode::bad_property, element.count_offset,
                       compose("the coordinate \"{}\" is a list", wanted));
      }
      found->meaning = meaning;
    }
    if (element.count > kMaxCount) {
      return fail_at(IoErrorCode::too_many_elements, element.count_offset,
                     compose("{} vertices; at most {} can be read", element.count, kMaxCount));
    }
    element.kind = PlyElementKind::vertices;
    header_.vertex_count = element.count;
    return true;
  }

  bool mark_faces(PlyElement& element, PlyElementKind kind) {
    for (PlyProperty& property : element.properties) {
      if (property.name != "vertex_indices" && property.name != "vertex_index") continue;
      if (!property.is_list || !is_integer(property.type)) {
        return fail_at(IoErrorCode::bad_property, element.count_offset,
                       compose("property {} of element {} must be a list of integers",
                               in_quotes(property.name), in_quotes(element.name)));
      }
      property.meaning = PlyMeaning::vertex_indices;
      element.kind = kind;
      return true;
    }
    return fail_at(IoErrorCode::missing_property, element.count_offset,
                   compose("element {} has no list \"vertex_indices\" or \"vertex_index\"",
                           in_quotes(element.name)));
  }

  std::span<const char> bytes_;
  TextCursor cursor_;
  PlyHeader header_;
  bool has_format_ = false;
  bool ends_with_cr_alone_ = false;
  Failure failure_;
};

}  // namespace

std::size_t PlyElement::smallest_record_bytes() const noexcept {
  std::size_t bytes = 0;
  for (const PlyProperty& property : properties) {
    bytes += size_bytes(property.is_list ? property.count_type : property.type);
  }
  return bytes;
}

bool PlyElement::has_lists() const noexcept {
  return std::ranges::any_of(properties, &PlyProperty::is_list);
}

Parsed<PlyHeader> read_ply_header(std::span<const char> bytes) {
  return HeaderReader(bytes).read();
}

}  // namespace hedgerow::io
