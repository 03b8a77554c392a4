// SPDX-License-Identifier: GPL-3.0-or-later
// Lanes for compilers without vector types: plain arrays, number by number.
#pragma once

#include <cstddef>
#include <cstdint>

namespace ridgecraft::unfold {

/// `count` numbers; operators work on each for itself, a single number stands for `count` equal ones.
template <typename Number, std::size_t count>
struct PortableLanes {
  Number number[count];  // NOLINT(modernize-avoid-c-arrays): braces as for a vector type

  constexpr Number& operator[](std::size_t lane) { return number[lane]; }
  constexpr Number operator[](std::size_t lane) const { return number[lane]; }

  friend constexpr PortableLanes operator+(const PortableLanes& a, const PortableLanes& b) {
    return each(a, b, [](Number x, Number y) { return x + y; });
  }
  friend constexpr PortableLanes operator-(const PortableLanes& a, const PortableLanes& b) {
    return each(a, b, [](Number x, Number y) { return x - y; });
  }
  friend constexpr PortableLanes operator*(const PortableLanes& a, const PortableLanes& b) {
    return each(a, b, [](Number x, Number y) { return x * y; });
  }
  friend constexpr PortableLanes operator+(const PortableLanes& a, Number b) { return a + all(b); }
  friend constexpr PortableLanes operator-(const PortableLanes& a, Number b) { return a - all(b); }
  friend constexpr PortableLanes operator*(const PortableLanes& a, Number b) { return a * all(b); }
  friend constexpr PortableLanes operator*(Number a, const PortableLanes& b) { return all(a) * b; }

  /// -1 in the lanes where a is less than b, 0 in the others.
  friend constexpr PortableLanes<std::int32_t, count> operator<(const PortableLanes& a,
                                                                const PortableLanes& b) {
    PortableLanes<std::int32_t, count> holds{};
    for (std::size_t lane = 0; lane < count; ++lane) {
      holds[lane] = a[lane] < b[lane] ? -1 : 0;
    }
    return holds;
  }

 private:
  static constexpr PortableLanes all(Number value) {
    PortableLanes lanes{};
    for (Number& number : lanes.number) {
      number = value;
    }
    return lanes;
  }
  template <typename Operation>
  static constexpr PortableLanes each(const PortableLanes& a, const PortableLanes& b, Operation operation) {
    PortableLanes lanes{};
    for (std::size_t lane = 0; lane < count; ++lane) {
      lanes[lane] = operation(a[lane], b[lane]);
    }
    return lanes;
  }
};

using PortableFloatLanes = PortableLanes<float, 4>;
using PortableIntLanes = PortableLanes<std::int32_t, 4>;
using PortableDoubleLanes = PortableLanes<double, 2>;

/// Bit k: lane k of a comparison's result holds.
[[nodiscard]] constexpr std::uint32_t bits_of(const PortableIntLanes& holds) {
  std::uint32_t bits = 0;
  for (unsigned lane = 0; lane < 4; ++lane) {
    bits |= holds[lane] != 0 ? 1U << lane : 0U;
  }
  return bits;
}

template <typename Number, std::size_t count>
[[nodiscard]] constexpr PortableLanes<Number, count> smaller(PortableLanes<Number, count> a,
                                                             const PortableLanes<Number, count>& b) {
  for (std::size_t lane = 0; lane < count; ++lane) {
    a[lane] = a[lane] < b[lane] ? a[lane] : b[lane];
  }
  return a;
}
template <typename Number, std::size_t count>
[[nodiscard]] constexpr PortableLanes<Number, count> larger(PortableLanes<Number, count> a,
                                                            const PortableLanes<Number, count>& b) {
  for (std::size_t lane = 0; lane < count; ++lane) {
    a[lane] = a[lane] > b[lane] ? a[lane] : b[lane];
  }
  return a;
}

}  // namespace ridgecraft::unfold
