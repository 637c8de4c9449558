// Points in the plane as text; the formats are described in hedgerow/io/points.h.
#include <algorithm>
#include <cctype>
#include <utility>

#include "compose.h"
#include "points.h"
#include "text_cursor.h"

namespace hedgerow::io {

namespace {

constexpr const char* kAxes = "xy";

/// What the two formats have in common.
class PointsReader {
 public:
  PointsReader(ReadContext& context, char separator)
      : context_(context), cursor_(context.bytes), separator_(separator) {
    cursor_.set_position(context.bytes.data() + byte_order_mark_size(context.bytes));
  }

 protected:
  ~PointsReader() = default;

  bool fail(IoErrorCode code, const char* place, std::string message) {
    failure_ = Failure{code, cursor_.offset_of(place), Place::text, std::move(message)};
    return false;
  }
  // To the next line with a point, if there is one.
  bool begin_point() {
    cursor_.skip_space_and_comments();
    context_.progress.at(cursor_.offset());
    return !cursor_.at_end();
  }
  bool read_coordinate(std::size_t axis, double& value) {
    const char* place = cursor_.position();
    const NumberStatus status = cursor_.read_double(value, separator_);
    if (status == NumberStatus::ok) return true;
    if (status == NumberStatus::non_finite && context_.options.keep_non_finite) return true;
    const std::string word = in_quotes(field_at(place));
    if (status == NumberStatus::non_finite) {
      return fail(IoErrorCode::non_finite, place,
                  compose("{} of point {} is {}", kAxes[axis], points_.size(), word));
    }
    if (field_at(place).empty()) return fail_missing(axis);
    return fail(
        IoErrorCode::bad_number, place,
        compose("{} of point {} is {}, which is no number", kAxes[axis], points_.size(), word));
  }
  bool fail_missing(std::size_t axis) {
    return fail(IoErrorCode::missing_value, cursor_.position(),
                compose("point {} has no {}", points_.size(), kAxes[axis]));
  }
  bool push(const Point2& point) {
    if (static_cast<std::int64_t>(points_.size()) >= std::int64_t{kMaxCount}) {
      return fail(IoErrorCode::too_many_elements, cursor_.position(),
                  compose("more than {} points", kMaxCount));
    }
    points_.push_back(point);
    return true;
  }
  [[nodiscard]] std::string_view field_at(const char* place) const {
    const char* end = place;
    while (end != cursor_.end() && *end != separator_ &&
           detail::class_of(*end) == detail::kWordCharacter) {
      ++end;
    }
    return {place, static_cast<std::size_t>(end - place)};
  }

  ReadContext& context_;
  TextCursor cursor_;
  char separator_;
  std::vector<Point2> points_;
  Failure failure_;
};

class XyReader : PointsReader {
 public:
  explicit XyReader(ReadContext& context) : PointsReader(context, ' ') {}

  Parsed<std::vector<Point2>> read() {
    while (begin_point()) {
      if (!read_line()) return tl::unexpected<Failure>(std::move(failure_));
    }
    return std::move(points_);
  }

 private:
  bool read_line() {
    Point2 point{};
    for (std::size_t axis = 0; axis < 2; ++axis) {
      if (cursor_.ends_before_comment()) return fail_missing(axis);
      if (!read_coordinate(axis, point[axis])) return false;
    }
    if (!cursor_.ends_before_comment()) {
      context_.warn("extra-values", cursor_.offset(), Place::text,
                    "more than x and y on a line; the rest is skipped");
      cursor_.skip_to_line_end();
    }
    return push(point);
  }
};

class CsvReader : PointsReader {
 public:
  explicit CsvReader(ReadContext& context) : PointsReader(context, ',') {}

  Parsed<std::vector<Point2>> read() {
    bool is_first = true;
    while (begin_point()) {
      const bool is_header = std::exchange(is_first, false) && !begins_with_number();
      if (is_header) {
        read_header();
      } else if (!read_line()) {
        return tl::unexpected<Failure>(std::move(failure_));
      }
    }
    return std::move(points_);
  }

 private:
  [[nodiscard]] bool begins_with_number() const {
    TextCursor there = cursor_;
    double value = 0;
    const NumberStatus status = there.read_double(value, separator_);
    return status == NumberStatus::ok || status == NumberStatus::non_finite;
  }

  // One field, and the comma behind it if there is one; whether there was.
  bool next_field(std::string& field) {
    field.clear();
    cursor_.skip_blanks();
    if (cursor_.at('"')) {
      read_quoted(field);
    }
    while (!cursor_.at_line_end() && !cursor_.at(separator_)) {
      field += *cursor_.position();
      cursor_.step();
    }
    while (!field.empty() && detail::class_of(field.back()) == detail::kBlank) field.pop_back();
    return skip_separator();
  }
  // Two quotes stand for one; a line end ends a quotation that is not closed.
  void read_quoted(std::string& field) {
    cursor_.step();
    while (!cursor_.at_line_end()) {
      const bool is_quote = cursor_.at('"');
      if (is_quote) cursor_.step();
      if (is_quote && !cursor_.at('"')) return;
      if (cursor_.at_line_end()) return;
      field += *cursor_.position();
      cursor_.step();
    }
  }
  bool skip_separator() {
    if (!cursor_.at(separator_)) return false;
    cursor_.step();
    return true;
  }

  void read_header() {
    std::size_t found[2] = {kNone, kNone};
    std::string field;
    bool has_more = true;
    for (std::size_t column = 0; has_more; ++column) {
      has_more = next_field(field);
      for (std::size_t axis = 0; axis < 2; ++axis) {
        const bool is_name =
            field.size() == 1 && std::tolower(static_cast<unsigned char>(field[0])) == kAxes[axis];
        if (is_name && found[axis] == kNone) found[axis] = column;
      }
    }
    if (found[0] == kNone || found[1] == kNone) return;
    std::copy_n(found, 2, columns_);
  }

  bool read_line() {
    Point2 point{};
    bool has_more = true;
    const std::size_t last = std::max(columns_[0], columns_[1]);
    std::string skipped;
    for (std::size_t column = 0; column <= last; ++column) {
      const std::size_t axis = column == columns_[0] ? 0 : 1;
      if (column != columns_[axis]) {
        has_more = has_more && next_field(skipped);
        continue;
      }
      cursor_.skip_blanks();
      if (!has_more || cursor_.at_line_end()) return fail_missing(axis);
      if (!read_coordinate(axis, point[axis])) return false;
      if (!end_field()) return false;
      has_more = skip_separator();
    }
    cursor_.skip_to_line_end();
    return push(point);
  }
  bool end_field() {
    cursor_.skip_blanks();
    if (cursor_.at_line_end() || cursor_.at(separator_)) return true;
    return fail(IoErrorCode::bad_number, cursor_.position(),
                compose("{} follows a number of point {}; fields are apart by commas",
                        in_quotes(field_at(cursor_.position())), points_.size()));
  }

  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  std::size_t columns_[2] = {0, 1};  // of x and of y
};

}  // namespace

Parsed<std::vector<Point2>> parse_xy(ReadContext& context) { return XyReader(context).read(); }
Parsed<std::vector<Point2>> parse_csv(ReadContext& context) { return CsvReader(context).read(); }

}  // namespace hedgerow::io
