#include "kernels/term_window.h"

#include <algorithm>
#include <bit>
#include <type_traits>

#include "kernels/gather_normals.h"
#include "kernels/prefetch.h"

namespace hedgerow::kernels {

namespace {

constexpr std::size_t kCacheLine = 64;
constexpr std::ptrdiff_t kLineLength = kCacheLine / sizeof(Index);

}  // namespace

Index TermWindow::capacity_for(Index face_count, NormalWeight weight) noexcept {
  const Index most = rows_of(weight) == 1 ? 1 << 14 : 1 << 13;
  const auto faces = static_cast<std::make_unsigned_t<Index>>(std::max(face_count, kStep));
  return std::min(most, static_cast<Index>(std::bit_ceil(faces)));
}

std::size_t TermWindow::bytes(Index capacity, NormalWeight weight) noexcept {
  if (capacity == 0) return 0;
  const std::size_t rows = static_cast<std::size_t>(capacity) *
                           static_cast<std::size_t>(rows_of(weight)) * sizeof(TermRow);
  return rows + kCacheLine;
}

TermWindow::TermWindow(std::byte* memory, Index capacity, NormalWeight weight) noexcept
    : rows_(reinterpret_cast<TermRow*>(memory)),
      capacity_(capacity),
      row_count_(rows_of(weight)),
      credit_(capacity) {
  if (capacity > 0) rows_[zero_row()] = {};
}

bool TermWindow::move(Index first, Index last, const GatherInput& input) noexcept {
  const Index begin = std::min(first, begin_);
  const Index end = std::max(last, end_);
  if (begin_ < end_ && end - begin <= capacity_ && pay(begin_ - begin + end - end_)) {
    fill(begin, begin_, input);
    fill(end_, end, input);
    begin_ = begin;
    end_ = end;
    return true;
  }
  if (first >= std::max(begin_, last - capacity_) && first <= end_ && pay(last - end_)) {
    fill(end_, last, input);
    end_ = last;
    begin_ = std::max(begin_, last - capacity_);
    return true;
  }
  if (last - first <= capacity_ && pay(last - first)) {
    fill(first, last, input);
    begin_ = first;
    end_ = last;
    return true;
  }
  return false;
}

bool TermWindow::pay(Index faces) noexcept {
  if (faces > credit_) return false;
  credit_ -= faces;
  return true;
}

void TermWindow::fill(Index begin, Index end, const GatherInput& input) const noexcept {
  const Index face_count = input.halfedge_count / 3;
  for (Index f = begin; f < std::min(end, face_count);) {
    const Index place = f & (capacity_ - 1);
    const Index count = std::min({end - f, face_count - f, capacity_ - place});
    const std::ptrdiff_t corner = 3 * static_cast<std::ptrdiff_t>(f);
    fill_term_rows({input.origin + corner, count, input.halfedge_count - corner}, input.points,
                   input.weight, rows_ + static_cast<std::ptrdiff_t>(place) * row_count_);
    // The walks that come to these faces will read this.
    const Index* opposite = input.opposite + corner;
    for (std::ptrdiff_t i = 0; i < 3 * count; i += kLineLength) prefetch_ahead(opposite + i);
    f += count;
  }
}

}  // namespace hedgerow::kernels
