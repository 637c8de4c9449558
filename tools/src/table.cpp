#include "table.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "hedgerow/assert.h"
#include "terminal.h"

namespace hedgerow::tool {

void Table::add(std::vector<std::string> cells) {
  HEDGEROW_ASSERT(cells.size() <= headings_.size());
  cells.resize(headings_.size());
  rows_.push_back(std::move(cells));
}

std::string Table::line(const std::vector<std::string>& cells,
                        const std::vector<std::size_t>& widths) const {
  std::string out;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (i > 0) out += "  ";
    out += headings_[i].align == Align::left ? fmt::format("{:<{}}", cells[i], widths[i])
                                             : fmt::format("{:>{}}", cells[i], widths[i]);
  }
  out.erase(out.find_last_not_of(' ') + 1);
  return out;
}

std::string Table::text(bool colour) const {
  std::vector<std::string> titles;
  std::vector<std::size_t> widths;
  bool has_titles = false;
  for (const Heading& heading : headings_) {
    titles.push_back(heading.title);
    widths.push_back(heading.title.size());
    has_titles = has_titles || !heading.title.empty();
  }
  for (const auto& row : rows_) {
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  }
  std::string out;
  if (has_titles) out += styled(line(titles, widths), Style::heading, colour) + '\n';
  for (const auto& row : rows_) out += line(row, widths) + '\n';
  return out;
}

std::string grouped(std::int64_t number) {
  std::string digits = fmt::format("{}", number);
  const std::size_t first = number < 0 ? 1 : 0;
  for (std::size_t i = digits.size(); i > first + 3; i -= 3) digits.insert(i - 3, 1, ',');
  return digits;
}

std::string short_text(double number) {
  if (!std::isfinite(number)) return "-";
  if (number == 0) return "0";
  const int magnitude = static_cast<int>(std::floor(std::log10(std::abs(number))));
  return fmt::format("{:.{}f}", number, std::clamp(2 - magnitude, 0, 9));
}

std::string byte_text(std::int64_t bytes) {
  constexpr std::array<const char*, 5> kUnits = {"B", "kB", "MB", "GB", "TB"};
  auto value = static_cast<double>(bytes);
  std::size_t unit = 0;
  while (std::abs(value) >= 1000 && unit + 1 < kUnits.size()) {
    value /= 1000;
    ++unit;
  }
  return unit == 0 ? fmt::format("{} B", bytes)
                   : fmt::format("{} {}", short_text(value), kUnits[unit]);
}

std::string time_text(double milliseconds) {
  if (milliseconds >= 1000) return short_text(milliseconds / 1000) + " s";
  if (milliseconds < 1) return short_text(milliseconds * 1000) + " us";
  return short_text(milliseconds) + " ms";
}

}  // namespace hedgerow::tool
