// SPDX-License-Identifier: GPL-3.0-or-later
// Signed integers of 128 bits: the compiler's own where it has any, and builds don't ask for the portable
// way.
#pragma once

#include <compare>
#include <cstdint>

namespace ridgecraft {

/// Sums, differences and products as in two's complement, modulo 2^128; no division, nothing is reported when
/// a result doesn't fit.
class PortableInt128 {
 public:
  constexpr PortableInt128() = default;
  // As the compiler's own type: 64-bit integers are taken wherever one of these is asked for.
  constexpr PortableInt128(std::int64_t value)  // NOLINT(google-explicit-constructor)
      : low_(static_cast<std::uint64_t>(value)), high_(value < 0 ? ~std::uint64_t{0} : 0) {}

  friend constexpr PortableInt128 operator+(PortableInt128 a, PortableInt128 b) {
    const std::uint64_t low = a.low_ + b.low_;
    return {low, a.high_ + b.high_ + (low < a.low_ ? 1U : 0U)};
  }
  friend constexpr PortableInt128 operator-(PortableInt128 a) { return PortableInt128() - a; }
  friend constexpr PortableInt128 operator-(PortableInt128 a, PortableInt128 b) {
    return {a.low_ - b.low_, a.high_ - b.high_ - (a.low_ < b.low_ ? 1U : 0U)};
  }
  friend constexpr PortableInt128 operator*(PortableInt128 a, PortableInt128 b) {
    PortableInt128 product = product_of(a.low_, b.low_);
    product.high_ += a.low_ * b.high_ + a.high_ * b.low_;
    return product;
  }

  friend constexpr bool operator==(const PortableInt128&, const PortableInt128&) = default;
  friend constexpr std::strong_ordering operator<=>(const PortableInt128& a, const PortableInt128& b) {
    const auto a_high = static_cast<std::int64_t>(a.high_);
    const auto b_high = static_cast<std::int64_t>(b.high_);
    return a_high != b_high ? a_high <=> b_high : a.low_ <=> b.low_;
  }

 private:
  constexpr PortableInt128(std::uint64_t low, std::uint64_t high) : low_(low), high_(high) {}

  /// All 128 bits, from the four products of halves.
  static constexpr PortableInt128 product_of(std::uint64_t a, std::uint64_t b) {
    constexpr std::uint64_t half = 0xffffffff;
    const std::uint64_t low = (a & half) * (b & half);
    const std::uint64_t cross = (a >> 32) * (b & half) + (low >> 32);  // at most (2^32 - 1) 2^32: it fits
    const std::uint64_t other = (a & half) * (b >> 32) + (cross & half);
    return {(other << 32) | (low & half), (a >> 32) * (b >> 32) + (cross >> 32) + (other >> 32)};
  }

  std::uint64_t low_ = 0;
  std::uint64_t high_ = 0;
};

#if defined(__SIZEOF_INT128__) && !defined(RIDGECRAFT_PORTABLE)
__extension__ using Int128 = __int128;
#else
using Int128 = PortableInt128;
#endif

}  // namespace ridgecraft
