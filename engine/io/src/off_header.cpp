#include "off_header.h"

#include <string_view>
#include <utility>

namespace hedgerow::io {

namespace {

bool take_prefix(std::string_view& word, std::string_view prefix) noexcept {
  if (!word.starts_with(prefix)) return false;
  word.remove_prefix(prefix.size());
  return true;
}

void skip_comments(TextCursor& cursor) noexcept {
  cursor.skip_space();
  while (cursor.at('#')) {
    cursor.skip_line();
    cursor.skip_space();
  }
}

tl::unexpected<Failure> refuse(const TextCursor& cursor, IoErrorCode code, const char* place,
                               std::string message) {
  return failure(code, cursor.offset_of(place), Place::text, std::move(message));
}

}  // namespace

Parsed<OffVariant> read_off_keyword(TextCursor& cursor) {
  skip_comments(cursor);
  const char* start = cursor.position();
  OffVariant variant;
  const std::string_view keyword = cursor.word();
  if (!keyword.empty() && keyword[0] >= '0' && keyword[0] <= '9' && !keyword.ends_with("OFF")) {
    cursor.set_position(start);
    return variant;
  }
  std::string_view rest = keyword;
  variant.has_texture = take_prefix(rest, "ST");
  variant.has_colour = take_prefix(rest, "C");
  variant.has_normal = take_prefix(rest, "N");
  const bool has_fourth = take_prefix(rest, "4");
  const bool has_dimension = take_prefix(rest, "n");
  if (rest != "OFF" && keyword != "off") {
    return refuse(cursor, IoErrorCode::bad_header, start,
                  "the file begins with " + in_quotes(keyword) + " instead of \"OFF\"");
  }
  if (has_fourth || has_dimension) {
    return refuse(cursor, IoErrorCode::unsupported_variant, start,
                  "the variant " + in_quotes(keyword) + " (" +
                      (has_dimension ? "points of any dimension" : "homogeneous coordinates") +
                      ") is not read");
  }
  cursor.skip_blanks();
  const char* place = cursor.position();
  if (cursor.at_line_end() || cursor.at('#')) return variant;
  const std::string_view word = cursor.word();
  if (word == "BINARY") {
    variant.is_binary = true;
    cursor.skip_blanks();
    if (!cursor.at('\n') && !cursor.at('\r')) {
      return refuse(cursor, IoErrorCode::bad_header, cursor.position(),
                    "\"OFF BINARY\" must be followed by a line end");
    }
    cursor.skip_line_end();
    return variant;
  }
  cursor.set_position(place);  // counts on the line of the keyword
  return variant;
}

}  // namespace hedgerow::io
