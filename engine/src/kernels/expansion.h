#pragma once

#include <array>
#include <cmath>
#include <cstddef>

/// Exact sums and products of doubles as sums of doubles that do not overlap.
///
/// Needs round to nearest even, no fused multiply-add, and no result that overflows or underflows.
/// After J. Shewchuk, Adaptive precision floating-point arithmetic and fast robust geometric
/// predicates, Discrete & Computational Geometry 18, 1997.
namespace hedgerow::kernels {

/// A rounded result and what rounding took away: head + tail is the exact one.
struct Rounded {
  double head;
  double tail;
};

[[nodiscard]] constexpr Rounded exact_sum(double a, double b) noexcept {
  const double head = a + b;
  const double b_part = head - a;
  const double a_part = head - b_part;
  return {head, (a - a_part) + (b - b_part)};
}

[[nodiscard]] inline Rounded exact_product(double a, double b) noexcept {
  const double head = a * b;
  return {head, std::fma(a, b, -head)};
}

/// The sum of parts[0 .. size), smallest magnitude first, none of them zero.
template <std::size_t Capacity>
struct Expansion {
  std::array<double, Capacity> parts;
  std::size_t size = 0;

  void append(double part) noexcept {
    if (part != 0) parts[size++] = part;
  }
  /// -1, 0 or 1: the largest part outweighs all others.
  [[nodiscard]] int sign() const noexcept {
    if (size == 0) return 0;
    return parts[size - 1] < 0 ? -1 : 1;
  }
};

[[nodiscard]] inline Expansion<2> expand(Rounded value) noexcept {
  Expansion<2> result;
  result.append(value.tail);
  result.append(value.head);
  return result;
}

/// Linear: merges the parts by magnitude, then carries upwards.
template <std::size_t M, std::size_t N>
[[nodiscard]] Expansion<M + N> operator+(const Expansion<M>& a, const Expansion<N>& b) noexcept {
  Expansion<M + N> result;
  std::size_t i = 0;
  std::size_t j = 0;
  const auto smallest = [&] {
    const bool is_a = j == b.size || (i < a.size && std::abs(a.parts[i]) < std::abs(b.parts[j]));
    return is_a ? a.parts[i++] : b.parts[j++];
  };
  double carry = 0;
  while (i < a.size || j < b.size) {
    const Rounded sum = exact_sum(carry, smallest());
    result.append(sum.tail);
    carry = sum.head;
  }
  result.append(carry);
  return result;
}

template <std::size_t N>
[[nodiscard]] Expansion<2 * N> operator*(const Expansion<N>& a, double factor) noexcept {
  Expansion<2 * N> result;
  double carry = 0;
  for (std::size_t i = 0; i < a.size; ++i) {
    const Rounded product = exact_product(a.parts[i], factor);
    const Rounded low = exact_sum(carry, product.tail);
    const Rounded high = exact_sum(product.head, low.head);
    result.append(low.tail);
    result.append(high.tail);
    carry = high.head;
  }
  result.append(carry);
  return result;
}

}  // namespace hedgerow::kernels
