#include "hedgerow/growing_column.h"

#include <algorithm>

namespace hedgerow {

namespace {
// From here on memory comes straight from the system: what is never written costs nothing, but each
// move writes all of it to fresh pages. So large columns grow by more.
constexpr std::size_t kLarge = std::size_t{1} << 20;
}  // namespace

void GrowingColumn::resize(std::size_t size, Index value) {
  if (size > size_) {
    make_room(size - size_);
    std::fill(storage_.data() + size_, storage_.data() + size, value);
  }
  size_ = size;
}

void GrowingColumn::grow(std::size_t more) {
  move_to(std::max(size_ + more, (size_ < kLarge ? 2 : 3) * size_));
}

void GrowingColumn::move_to(std::size_t capacity) {
  Buffer<Index> larger(capacity);
  std::copy_n(storage_.data(), size_, larger.data());
  storage_ = std::move(larger);
}

}  // namespace hedgerow
