// Wavefront OBJ, as described in "Advanced Visualizer" appendix B1 (1995): polygonal geometry only.
#include <cmath>
#include <limits>

#include "compose.h"
#include "face_collector.h"
#include "read_context.h"
#include "text_cursor.h"

namespace hedgerow::io {

namespace {

constexpr std::string_view kSkippedStatements[] = {
    "vt",       "vn",     "vp",     "g",    "o",          "s",     "l",     "p",         "usemtl",
    "mtllib",   "usemap", "maplib", "mg",   "cstype",     "deg",   "curv",  "curv2",     "surf",
    "parm",     "trim",   "hole",   "scrv", "sp",         "end",   "con",   "bevel",     "c_interp",
    "d_interp", "lod",    "bmat",   "step", "shadow_obj", "ctech", "stech", "trace_obj", "call",
    "csh",      "bsp",    "bzp",    "cdc",  "cdp",        "res",   "bmat"};

class ObjReader {
 public:
  // `vertex_limit` is unknown in the first pass: a face may refer to vertices that come after it.
  // If some reference turns out to lead nowhere, a second pass that knows the count finds it. So a
  // good file is read once, and no place is stored for any face.
  ObjReader(ReadContext& context, std::int64_t vertex_limit)
      : context_(context), cursor_(context.bytes), vertex_limit_(vertex_limit) {}

  Parsed<Soup> read() {
    cursor_.set_position(cursor_.position() + byte_order_mark_size(context_.bytes));
    while (!cursor_.at_end()) {
      context_.progress.at(cursor_.offset());
      if (!read_statement()) return tl::unexpected<Failure>(std::move(failure_));
      cursor_.skip_line_end();
    }
    if (known_count_ == 0 && unknown_count_ != 0) {
      return failure(IoErrorCode::unknown_format, first_unknown_, Place::text,
                     "no line of this file is an OBJ statement");
    }
    Soup soup;
    soup.xyz = xyz_.take();
    faces_.move_into(soup);
    return soup;
  }

  [[nodiscard]] std::int64_t vertex_count() const noexcept { return vertex_count_; }
  [[nodiscard]] std::int64_t largest_index() const noexcept { return largest_index_; }

 private:
  bool fail(IoErrorCode code, const char* place, std::string message) {
    failure_ = Failure{code, cursor_.offset_of(place), Place::text, std::move(message)};
    return false;
  }

  // A backslash right before the line end joins the next line to this one.
  void skip_blanks() {
    cursor_.skip_blanks();
    while (cursor_.at('\\')) {
      const char* backslash = cursor_.position();
      cursor_.step();
      if (!cursor_.at_line_end()) {
        cursor_.set_position(backslash);
        return;
      }
      cursor_.skip_line_end();
      cursor_.skip_blanks();
    }
  }

  bool at_statement_end() { return cursor_.at_line_end() || cursor_.at('#'); }

  bool read_statement() {
    skip_blanks();
    if (cursor_.at_line_end()) return true;
    const char* start = cursor_.position();
    if (*start == '#') {
      // Not continued: comments end in paths with a backslash more often than in continuations.
      cursor_.skip_to_line_end();
      return true;
    }
    const std::string_view word = cursor_.word();
    if (word == "v" || word == "V") return read_vertex();
    if (word == "f" || word == "F" || word == "fo") return read_face(start);
    return skip_statement(word, start);
  }

  bool skip_statement(std::string_view word, const char* start) {
    bool is_known = false;
    for (const std::string_view known : kSkippedStatements) {
      is_known = is_known || equals_ignoring_case(word, known);
    }
    if (is_known) {
      ++known_count_;
    } else {
      if (unknown_count_++ == 0) first_unknown_ = cursor_.offset_of(start);
      context_.warn("unknown-statement", cursor_.offset_of(start), Place::text,
                    "skipped: the statement " + in_quotes(word) + " is not known");
    }
    for (;;) {
      cursor_.skip_to_line_end();
      const char* line_end = cursor_.position();
      if (cursor_.at_end() || line_end[-1] != '\\') return true;
      cursor_.skip_line_end();
    }
  }

  bool read_vertex() {
    ++known_count_;
    float* xyz = xyz_.append(3);
    for (int axis = 0; axis < 3; ++axis) {
      skip_blanks();
      const char* place = cursor_.position();
      switch (cursor_.read_float(xyz[axis])) {
        case NumberStatus::ok:
          break;
        case NumberStatus::non_finite:
          if (context_.options.keep_non_finite) break;
          return fail(IoErrorCode::non_finite, place,
                      compose("coordinate {} of vertex {} is {}", "xyz"[axis], vertex_count_,
                              in_quotes(word_at(place))));
        case NumberStatus::none:
          return missing_coordinate(place, axis);
        default:
          if (*place == '#') return missing_coordinate(place, axis);
          return fail(IoErrorCode::bad_number, place,
                      compose("coordinate {} of vertex {} is {}, which is no number", "xyz"[axis],
                              vertex_count_, in_quotes(word_at(place))));
      }
    }
    if (vertex_count_ == kMaxCount) {
      return fail(IoErrorCode::too_many_elements, cursor_.position(),
                  compose("more than {} vertices", kMaxCount));
    }
    ++vertex_count_;
    return skip_vertex_rest();
  }

  bool missing_coordinate(const char* place, int axis) {
    return fail(IoErrorCode::missing_value, place,
                compose("vertex {} has {} of 3 coordinates", vertex_count_, axis));
  }

  // A weight or a colour may follow. They are not used, but a word among them means that the line
  // is not what it seems.
  bool skip_vertex_rest() {
    for (;;) {
      skip_blanks();
      if (at_statement_end()) {
        cursor_.skip_to_line_end();
        return true;
      }
      const char* place = cursor_.position();
      float unused = 0;
      if (cursor_.read_float(unused) == NumberStatus::bad) {
        return fail(IoErrorCode::bad_number, place,
                    compose("{} behind the coordinates of vertex {} is no number",
                            in_quotes(word_at(place)), vertex_count_ - 1));
      }
    }
  }

  std::string_view word_at(const char* place) {
    TextCursor at_place = cursor_;
    at_place.set_position(place);
    return at_place.word();
  }

  bool read_face(const char* start) {
    ++known_count_;
    std::size_t degree = 0;
    for (;; ++degree) {
      skip_blanks();
      if (at_statement_end()) break;
      if (!read_corner()) return false;
    }
    cursor_.skip_to_line_end();
    faces_.end_face();
    if (faces_.is_full(degree)) {
      return fail(IoErrorCode::too_many_elements, start,
                  compose("more than {} faces or corners", kMaxCount));
    }
    return true;
  }

  // v, v/vt, v//vn or v/vt/vn; a part behind a slash may be empty.
  bool read_corner() {
    const char* place = cursor_.position();
    std::int64_t index = 0;
    const NumberStatus status = cursor_.read_integer(index);
    bool is_well_formed = status == NumberStatus::ok || status == NumberStatus::too_large;
    for (int part = 0; part < 2 && is_well_formed && cursor_.at('/'); ++part) {
      cursor_.step();
      std::int64_t unused = 0;
      const bool is_empty = cursor_.at('/') || cursor_.at_word_end();
      is_well_formed = is_empty || cursor_.read_integer(unused) != NumberStatus::bad;
    }
    is_well_formed = is_well_formed && (cursor_.at_word_end() || is_continued());
    if (!is_well_formed) {
      return fail(IoErrorCode::bad_number, place,
                  compose("corner {} of face {} is no index", in_quotes(word_at(place)),
                          faces_.face_count()));
    }
    return add_corner(index, status == NumberStatus::too_large, place);
  }

  bool is_continued() {
    TextCursor next = cursor_;
    if (!next.at('\\')) return false;
    next.step();
    return next.at_line_end();
  }

  bool add_corner(std::int64_t index, bool is_too_large, const char* place) {
    const std::int64_t vertex = index > 0 ? index - 1 : vertex_count_ + index;
    const bool is_missing = is_too_large || index == 0 || vertex < 0 || vertex >= vertex_limit_;
    if (is_missing && !context_.options.keep_out_of_range) {
      const bool is_final = index > 0 && vertex_limit_ != kUnknown;
      const std::int64_t count = is_final ? vertex_limit_ : vertex_count_;
      return fail(IoErrorCode::index_out_of_range, place,
                  compose("face {} refers to vertex {}, the file has {}{}", faces_.face_count(),
                          index_word(place), count,
                          is_final ? "" : (index < 0 ? " so far" : " so far; the first is 1")));
    }
    largest_index_ = is_too_large ? largest_index_ : std::max(largest_index_, vertex);
    const bool fits = !is_too_large && index != 0 && vertex <= kMaxCount &&
                      vertex >= std::numeric_limits<Index>::min();
    faces_.add_corner(fits ? static_cast<Index>(vertex) : kInvalidIndex);
    return true;
  }

  std::string index_word(const char* place) {
    TextCursor at_place = cursor_;
    at_place.set_position(place);
    std::int64_t unused = 0;
    static_cast<void>(at_place.read_integer(unused));
    const auto length = static_cast<std::size_t>(at_place.position() - place);
    return length <= 40 ? std::string(place, length) : std::string(place, 40) + "...";
  }

 public:
  static constexpr std::int64_t kUnknown = std::numeric_limits<std::int64_t>::max();

 private:
  ReadContext& context_;
  TextCursor cursor_;
  std::int64_t vertex_limit_;
  GrowBuffer<float> xyz_;
  FaceCollector faces_;
  std::int64_t vertex_count_ = 0;
  std::int64_t largest_index_ = -1;
  std::int64_t known_count_ = 0;
  std::int64_t unknown_count_ = 0;
  std::size_t first_unknown_ = 0;
  Failure failure_;
};

}  // namespace

Parsed<Soup> read_obj(ReadContext& context) {
  if (std::optional<Failure> failed = check_is_text(context.bytes)) {
    return tl::unexpected<Failure>(std::move(*failed));
  }
  ObjReader reader(context, ObjReader::kUnknown);
  Parsed<Soup> soup = reader.read();
  if (!soup || context.options.keep_out_of_range ||
      reader.largest_index() < reader.vertex_count()) {
    return soup;
  }
  context.warnings.clear();
  return ObjReader(context, reader.vertex_count()).read();
}

}  // namespace hedgerow::io
