#include "text_cursor.h"

#include <cmath>
#include <cstring>
#include <limits>

#include <fast_float/fast_float.h>

namespace hedgerow::io {

template <class Number>
NumberStatus TextCursor::read_number(Number& value, char separator) noexcept {
  if (at_line_end()) return NumberStatus::none;
  const char* start = position_;
  if (*start == '+') {
    ++start;
    if (start != end_ && *start == '-') return NumberStatus::bad;
  }
  const auto [rest, error] = fast_float::from_chars(start, end_, value);
  // Newer versions report a result out of range as an error, with the same infinite value.
  if (error == std::errc::invalid_argument || rest == start) return NumberStatus::bad;
  const char* before = position_;
  position_ = rest;
  if (!at_word_end() && !at(separator)) {
    position_ = before;
    return NumberStatus::bad;
  }
  return std::isfinite(value) ? NumberStatus::ok : NumberStatus::non_finite;
}

NumberStatus TextCursor::read_float(float& value) noexcept { return read_number(value, ' '); }
NumberStatus TextCursor::read_double(double& value, char separator) noexcept {
  return read_number(value, separator);
}

NumberStatus TextCursor::read_integer(std::int64_t& value) noexcept {
  if (at_line_end()) return NumberStatus::none;
  const char* p = position_;
  const bool is_negative = *p == '-';
  if (*p == '-' || *p == '+') ++p;
  const char* digits = p;
  std::uint64_t magnitude = 0;
  bool is_too_large = false;
  constexpr std::uint64_t kLimit = std::numeric_limits<std::int64_t>::max();
  for (; p != end_; ++p) {
    const auto digit = static_cast<std::uint64_t>(static_cast<unsigned char>(*p)) - '0';
    if (digit > 9) break;
    if (magnitude > (kLimit - digit) / 10) {
      is_too_large = true;
    } else {
      magnitude = magnitude * 10 + digit;
    }
  }
  if (p == digits) return NumberStatus::bad;
  position_ = p;
  value =
      is_negative ? -static_cast<std::int64_t>(magnitude) : static_cast<std::int64_t>(magnitude);
  return is_too_large ? NumberStatus::too_large : NumberStatus::ok;
}

std::size_t byte_order_mark_size(std::span<const char> text) noexcept {
  return text.size() >= 3 && text[0] == '\xEF' && text[1] == '\xBB' && text[2] == '\xBF' ? 3 : 0;
}

LineColumn line_column(std::span<const char> text, std::size_t offset) noexcept {
  LineColumn place;
  std::size_t line_start = byte_order_mark_size(text);
  for (std::size_t i = line_start; i < offset && i < text.size(); ++i) {
    const bool is_first_of_two = text[i] == '\r' && i + 1 < text.size() && text[i + 1] == '\n';
    if ((text[i] == '\n' || text[i] == '\r') && !is_first_of_two) {
      ++place.line;
      line_start = i + 1;
    }
  }
  place.column = offset < line_start ? 1 : static_cast<std::int64_t>(offset - line_start) + 1;
  return place;
}

std::optional<Failure> check_is_text(std::span<const char> text) {
  if (text.size() >= 2) {
    const bool is_big = text[0] == '\xFE' && text[1] == '\xFF';
    const bool is_little = text[0] == '\xFF' && text[1] == '\xFE';
    if (is_big || is_little) {
      return Failure{IoErrorCode::utf16_text, 0, Place::text,
                     std::string("the file is UTF-16 (") + (is_big ? "big" : "little") +
                         "-endian); save it as UTF-8 or ASCII"};
    }
  }
  const void* nul = text.empty() ? nullptr : std::memchr(text.data(), 0, text.size());
  if (nul == nullptr) return std::nullopt;
  const auto offset = static_cast<std::size_t>(static_cast<const char*>(nul) - text.data());
  if (offset < 2 && text.size() >= 4 && (text[offset ^ 1] != 0) && text[offset + 2] == 0) {
    return Failure{
        IoErrorCode::utf16_text, offset, Place::text,
        "every second byte is 0: the file seems to be UTF-16; save it as UTF-8 or ASCII"};
  }
  return Failure{IoErrorCode::nul_byte, offset, Place::text, "a byte 0 in a text file"};
}

std::string in_quotes(std::string_view word) {
  constexpr std::size_t kLongest = 40;
  constexpr char kHex[] = "0123456789abcdef";
  std::string out = "\"";
  for (const char c : word.substr(0, kLongest)) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x20 && byte < 0x7f) {
      out += c;
    } else {
      out += "\\x";
      out += kHex[byte >> 4];
      out += kHex[byte & 15];
    }
  }
  if (word.size() > kLongest) out += "...";
  out += '"';
  return out;
}

bool equals_ignoring_case(std::string_view word, std::string_view lower) noexcept {
  if (word.size() != lower.size()) return false;
  for (std::size_t i = 0; i < word.size(); ++i) {
    const char c = word[i];
    if ((c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c) != lower[i]) return false;
  }
  return true;
}

}  // namespace hedgerow::io
