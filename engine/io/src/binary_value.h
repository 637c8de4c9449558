#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace hedgerow::io {

/// A value of the file's byte order from any address; `kSwap` if that is not this machine's order.
template <class T, bool kSwap>
[[nodiscard]] T load(const char* from) noexcept {
  std::array<char, sizeof(T)> bytes;
  std::memcpy(bytes.data(), from, sizeof(T));
  if constexpr (kSwap) std::reverse(bytes.begin(), bytes.end());
  return std::bit_cast<T>(bytes);
}

template <class T>
[[nodiscard]] T load_little_endian(const char* from) noexcept {
  return load<T, std::endian::native == std::endian::big>(from);
}

}  // namespace hedgerow::io
