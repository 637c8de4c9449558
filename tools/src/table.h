#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace hedgerow::tool {

/// Text in aligned columns: ASCII, two spaces between columns, no line longer than its cells need.
class Table {
 public:
  enum class Align : std::uint8_t { left, right };
  struct Heading {
    std::string title;
    Align align = Align::right;
  };

  /// Without titles there is no heading line.
  explicit Table(std::vector<Heading> headings) : headings_(std::move(headings)) {}

  /// Missing cells are empty; there may not be more than headings.
  void add(std::vector<std::string> cells);
  [[nodiscard]] bool empty() const noexcept { return rows_.empty(); }
  [[nodiscard]] std::string text(bool colour) const;

 private:
  [[nodiscard]] std::string line(const std::vector<std::string>& cells,
                                 const std::vector<std::size_t>& widths) const;

  std::vector<Heading> headings_;
  std::vector<std::vector<std::string>> rows_;
};

/// "1,234,567".
[[nodiscard]] std::string grouped(std::int64_t number);
/// "12.3 MB"; powers of 1000, as in GB/s.
[[nodiscard]] std::string byte_text(std::int64_t bytes);
/// "12.3 ms", "4.56 s" with three significant digits.
[[nodiscard]] std::string time_text(double milliseconds);
/// Three significant digits, never in exponent form; "-" if not finite.
[[nodiscard]] std::string short_text(double number);

}  // namespace hedgerow::tool
