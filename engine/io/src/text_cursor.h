#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "failure.h"

namespace hedgerow::io {

namespace detail {
enum CharacterClass : std::uint8_t { kWordCharacter = 0, kBlank = 1, kLineEnd = 2 };

inline constexpr std::array<std::uint8_t, 256> kCharacterClass = [] {
  std::array<std::uint8_t, 256> classes{};
  for (const char c : {' ', '\t', '\v', '\f'}) classes[static_cast<unsigned char>(c)] = kBlank;
  for (const char c : {'\n', '\r'}) classes[static_cast<unsigned char>(c)] = kLineEnd;
  return classes;
}();

inline std::uint8_t class_of(char c) noexcept {
  return kCharacterClass[static_cast<unsigned char>(c)];
}
}  // namespace detail

/// What came of reading one number.
enum class NumberStatus : std::uint8_t {
  ok,
  none,        ///< the line (or the file) ends here
  bad,         ///< not a number
  too_large,   ///< integer: beyond 64 bits
  non_finite,  ///< float: NaN, infinite, or too large for a float; the value is set
};

/// A place in text that never leaves it. Lines end with LF, CR LF or CR; blanks are space, tab,
/// vertical tab and form feed.
class TextCursor {
 public:
  explicit TextCursor(std::span<const char> text) noexcept
      : begin_(text.data()), position_(text.data()), end_(text.data() + text.size()) {}

  [[nodiscard]] const char* position() const noexcept { return position_; }
  void set_position(const char* position) noexcept { position_ = position; }
  [[nodiscard]] const char* end() const noexcept { return end_; }
  [[nodiscard]] std::size_t offset() const noexcept { return offset_of(position_); }
  [[nodiscard]] std::size_t offset_of(const char* place) const noexcept {
    return static_cast<std::size_t>(place - begin_);
  }
  [[nodiscard]] bool at_end() const noexcept { return position_ == end_; }
  [[nodiscard]] bool at_line_end() const noexcept {
    return position_ == end_ || detail::class_of(*position_) == detail::kLineEnd;
  }
  [[nodiscard]] bool at(char c) const noexcept { return position_ != end_ && *position_ == c; }
  void step() noexcept { ++position_; }

  void skip_blanks() noexcept {
    while (position_ != end_ && detail::class_of(*position_) == detail::kBlank) ++position_;
  }
  /// Blanks and line ends.
  void skip_space() noexcept {
    while (position_ != end_ && detail::class_of(*position_) != detail::kWordCharacter) ++position_;
  }
  void skip_to_line_end() noexcept {
    while (position_ != end_ && detail::class_of(*position_) != detail::kLineEnd) ++position_;
  }
  /// Over one line end, if there is one here.
  void skip_line_end() noexcept {
    if (position_ == end_) return;
    if (*position_ == '\r') {
      ++position_;
      if (position_ != end_ && *position_ == '\n') ++position_;
    } else if (*position_ == '\n') {
      ++position_;
    }
  }
  void skip_line() noexcept {
    skip_to_line_end();
    skip_line_end();
  }
  /// To the next word outside of comments, which run from '#' to the end of their line; on this
  /// line or a later one.
  void skip_space_and_comments() noexcept {
    skip_space();
    while (at('#')) {
      skip_line();
      skip_space();
    }
  }
  /// Over blanks; whether nothing but a comment is left on this line.
  [[nodiscard]] bool ends_before_comment() noexcept {
    skip_blanks();
    return at_line_end() || at('#');
  }
  /// The characters up to the next blank or line end; empty at a line end.
  [[nodiscard]] std::string_view word() noexcept {
    const char* start = position_;
    while (position_ != end_ && detail::class_of(*position_) == detail::kWordCharacter) ++position_;
    return {start, static_cast<std::size_t>(position_ - start)};
  }
  [[nodiscard]] std::string_view peek_word() noexcept {
    const char* start = position_;
    const std::string_view result = word();
    position_ = start;
    return result;
  }
  /// True if a number may end here: before a blank, a line end, a comment or the end of the text.
  [[nodiscard]] bool at_word_end() const noexcept {
    return position_ == end_ || detail::class_of(*position_) != detail::kWordCharacter ||
           *position_ == '#';
  }

  /// Correctly rounded; a leading + is allowed. Stands behind the number afterwards, or where it
  /// stood if there is none. The value of a number too large is infinite.
  [[nodiscard]] NumberStatus read_float(float& value) noexcept;
  /// The same for a double, which may also end before `separator`.
  [[nodiscard]] NumberStatus read_double(double& value, char separator) noexcept;
  /// Decimal digits with an optional sign; what follows them is the caller's to check.
  [[nodiscard]] NumberStatus read_integer(std::int64_t& value) noexcept;

 private:
  template <class Number>
  [[nodiscard]] NumberStatus read_number(Number& value, char separator) noexcept;

  const char* begin_;
  const char* position_;
  const char* end_;
};

struct LineColumn {
  std::int64_t line = 1;
  std::int64_t column = 1;
};

/// Line and column of an offset, both from 1; a UTF-8 byte order mark has no column. Linear: for
/// reports only.
[[nodiscard]] LineColumn line_column(std::span<const char> text, std::size_t offset) noexcept;

/// What is wrong with bytes that should be text: 16-bit units or a byte 0. None: it is text.
[[nodiscard]] std::optional<Failure> check_is_text(std::span<const char> text);

/// A byte order mark of UTF-8 has 3 bytes; without one the answer is 0.
[[nodiscard]] std::size_t byte_order_mark_size(std::span<const char> text) noexcept;

/// The word in quotes for a message: cut after 40 bytes, what cannot be shown as \xNN.
[[nodiscard]] std::string in_quotes(std::string_view word);

[[nodiscard]] bool equals_ignoring_case(std::string_view word, std::string_view lower) noexcept;

}  // namespace hedgerow::io
