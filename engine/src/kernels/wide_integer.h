#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

/// Whole numbers wide enough for the signs of products of differences of floats, on the stack.
namespace hedgerow::kernels {

/// A sign and a magnitude below 2^2048. The caller knows from the degree of his formula that no
/// result is larger; nothing is checked.
class WideInteger {
 public:
  constexpr WideInteger() noexcept = default;
  /// magnitude * 2^shift, with a minus sign if `is_negative`.
  constexpr WideInteger(std::uint32_t magnitude, std::size_t shift, bool is_negative) noexcept
      : is_negative_(is_negative) {
    if (magnitude == 0) return;
    const std::size_t low = shift / 32;
    const std::uint64_t bits = std::uint64_t{magnitude} << (shift % 32);
    limbs_[low] = static_cast<std::uint32_t>(bits);
    limbs_[low + 1] = static_cast<std::uint32_t>(bits >> 32U);
    size_ = low + 2;
    trim();
  }

  /// -1, 0 or 1.
  [[nodiscard]] constexpr int sign() const noexcept {
    return size_ == 0 ? 0 : is_negative_ ? -1 : 1;
  }

  friend constexpr WideInteger operator-(WideInteger a) noexcept {
    a.is_negative_ = !a.is_negative_;
    return a;
  }
  friend constexpr WideInteger operator+(const WideInteger& a, const WideInteger& b) noexcept {
    if (a.is_negative_ == b.is_negative_) return sum_of_magnitudes(a, b);
    return is_smaller(a, b) ? difference_of_magnitudes(b, a) : difference_of_magnitudes(a, b);
  }
  friend constexpr WideInteger operator-(const WideInteger& a, const WideInteger& b) noexcept {
    return a + -b;
  }
  friend constexpr WideInteger operator*(const WideInteger& a, const WideInteger& b) noexcept {
    WideInteger product;
    product.is_negative_ = a.is_negative_ != b.is_negative_;
    for (std::size_t i = 0; i < a.size_; ++i) {
      std::uint64_t carry = 0;
      for (std::size_t j = 0; j < b.size_; ++j) {
        carry += std::uint64_t{a.limbs_[i]} * b.limbs_[j] + product.limbs_[i + j];
        product.limbs_[i + j] = static_cast<std::uint32_t>(carry);
        carry >>= 32U;
      }
      if (carry != 0) product.limbs_[i + b.size_] = static_cast<std::uint32_t>(carry);
    }
    product.size_ = std::min(a.size_ + b.size_, kLimbCount);
    product.trim();
    return product;
  }

 private:
  static constexpr std::size_t kLimbCount = 64;

  static constexpr bool is_smaller(const WideInteger& a, const WideInteger& b) noexcept {
    if (a.size_ != b.size_) return a.size_ < b.size_;
    for (std::size_t i = a.size_; i-- > 0;) {
      if (a.limbs_[i] != b.limbs_[i]) return a.limbs_[i] < b.limbs_[i];
    }
    return false;
  }
  // With the sign of a.
  static constexpr WideInteger sum_of_magnitudes(const WideInteger& a,
                                                 const WideInteger& b) noexcept {
    WideInteger sum;
    sum.is_negative_ = a.is_negative_;
    const std::size_t size = std::max(a.size_, b.size_);
    std::uint64_t carry = 0;
    for (std::size_t i = 0; i < size; ++i) {
      carry += std::uint64_t{a.limbs_[i]} + b.limbs_[i];
      sum.limbs_[i] = static_cast<std::uint32_t>(carry);
      carry >>= 32U;
    }
    sum.size_ = size;
    if (carry != 0) sum.limbs_[sum.size_++] = static_cast<std::uint32_t>(carry);
    return sum;
  }
  // With the sign of a, whose magnitude is not the smaller one.
  static constexpr WideInteger difference_of_magnitudes(const WideInteger& a,
                                                        const WideInteger& b) noexcept {
    WideInteger difference;
    difference.is_negative_ = a.is_negative_;
    std::uint64_t borrow = 0;
    for (std::size_t i = 0; i < a.size_; ++i) {
      const std::uint64_t bits = std::uint64_t{a.limbs_[i]} - b.limbs_[i] - borrow;
      difference.limbs_[i] = static_cast<std::uint32_t>(bits);
      borrow = bits >> 63U;
    }
    difference.size_ = a.size_;
    difference.trim();
    return difference;
  }
  constexpr void trim() noexcept {
    while (size_ > 0 && limbs_[size_ - 1] == 0) --size_;
  }

  std::array<std::uint32_t, kLimbCount> limbs_{};  // those from size_ on are zero
  std::size_t size_ = 0;
  bool is_negative_ = false;
};

}  // namespace hedgerow::kernels
