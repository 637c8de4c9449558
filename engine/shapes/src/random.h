#pragma once

#include <cstdint>

namespace hedgerow::shapes {

/// Spreads every bit of `x` over all of the result (the mixer of splitmix64).
[[nodiscard]] constexpr std::uint64_t mixed(std::uint64_t x) noexcept {
  x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9U;
  x = (x ^ (x >> 27U)) * 0x94d049bb133111ebU;
  return x ^ (x >> 31U);
}

/// Numbers from a seed by splitmix64 (Steele, Lea, Flood 2014): the same on every machine, which
/// the distributions of the standard library do not promise.
class SplitMix {
 public:
  explicit constexpr SplitMix(std::uint64_t seed) noexcept : state_(seed) {}
  [[nodiscard]] constexpr std::uint64_t next() noexcept {
    state_ += 0x9e3779b97f4a7c15U;
    return mixed(state_);
  }
  /// 0 .. count - 1; the bias of the remainder is below count / 2^64.
  [[nodiscard]] constexpr std::uint64_t below(std::uint64_t count) noexcept {
    return next() % count;
  }

 private:
  std::uint64_t state_;
};

}  // namespace hedgerow::shapes
