// SPDX-License-Identifier: GPL-3.0-or-later
// Random numbers with one sequence on every machine.
#pragma once

#include <cstdint>
#include <vector>

namespace ridgecraft {

/// Small seeded generator with a fixed sequence on every machine (splitmix64, Steele, Lea, Flood 2014): the
/// standard library's distributions and shuffles differ between implementations.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  /// A sequence of its own for the i-th of many tasks that share a seed, so that what one draws doesn't
  /// depend on which others ran before it. Two uses of one seed that must not draw alike give one of them
  /// ~seed.
  [[nodiscard]] static Random stream(std::uint64_t seed, std::uint64_t i) {
    return Random(seed ^ (step * (i + 1)));
  }
  std::uint64_t next() {
    std::uint64_t z = (state_ += step);
    z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27U)) * 0x94d049bb133111ebULL;
    return z ^ (z >> 31U);
  }
  /// Uniform in 0 .. bound-1; bound at least 1 (multiply-shift: the bias is below 2^-32).
  std::uint32_t below(std::uint32_t bound) {
    return static_cast<std::uint32_t>(((next() >> 32U) * std::uint64_t{bound}) >> 32U);
  }
  /// Uniform in [0, 1).
  double unit() { return static_cast<double>(next() >> 11U) * 0x1.0p-53; }

 private:
  static constexpr std::uint64_t step = 0x9e3779b97f4a7c15ULL;  ///< 2^64 over the golden ratio, odd

  std::uint64_t state_;
};

/// One of them; there must be one.
template <class T>
[[nodiscard]] const T& pick(const std::vector<T>& from, Random& random) {
  return from[random.below(static_cast<std::uint32_t>(from.size()))];
}

}  // namespace ridgecraft
