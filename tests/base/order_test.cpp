// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers and points in order, and points at one place, against sorting and against looking at all pairs.
#include "base/order.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <vector>

#include <catch2/catch.hpp>

#include "base/context.hpp"
#include "base/random.hpp"

namespace ridgecraft {
namespace {

/// Bits of z, y and x in turn, from the highest on.
std::uint64_t interleaved(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
  std::uint64_t place = 0;
  for (int bit = 9; bit >= 0; --bit) {
    for (const std::uint32_t coordinate : {z, y, x}) {
      place = 2 * place + (coordinate >> bit) % 2;
    }
  }
  return place;
}

Vec3 cell_at(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
  return {static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)};
}

bool has_each_once(std::vector<std::uint32_t> order, std::size_t count) {
  std::sort(order.begin(), order.end());
  std::vector<std::uint32_t> all(count);
  std::iota(all.begin(), all.end(), 0U);
  return order == all;
}

}  // namespace

TEST_CASE("Points come in the order of their places on the curve, those of one cell in theirs") {
  Random random(11);
  for (const std::uint32_t side : {1024U, 16U, 2U}) {
    // Two corners make a cell of the curve as large as a whole step.
    std::vector<Vec3> points{{1023, 0, 0}, {0, 0, 0}};
    std::vector<std::uint64_t> place{interleaved(1023, 0, 0), 0};
    for (int i = 0; i < 2000; ++i) {
      const std::array<std::uint32_t, 3> at{random.below(side), random.below(side), random.below(side)};
      // Within the cell, but not beyond the box, which ends where the last cell begins.
      const double within = random.below(2) == 0 || std::max({at[0], at[1], at[2]}) == 1023 ? 0.0 : 0.75;
      points.push_back(cell_at(at[0], at[1], at[2]) + Vec3{within, within, within});
      place.push_back(interleaved(at[0], at[1], at[2]));
    }
    std::vector<std::uint32_t> expected(points.size());
    std::iota(expected.begin(), expected.end(), 0U);
    std::stable_sort(expected.begin(), expected.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return place[a] < place[b]; });
    CHECK(curve_order(points) == expected);
    // Powers of two and whole numbers round nothing.
    for (Vec3& p : points) {
      p = 0.125 * p - Vec3{64.0, 1024.0, -32.0};
    }
    CHECK(curve_order(points) == expected);
  }
}

TEST_CASE("A curve's order has each point once, whatever their extent") {
  CHECK(curve_order({}).empty());
  const std::vector<Vec3> one{{7, 7, 7}, {7, 7, 7}};
  CHECK(curve_order(one) == std::vector<std::uint32_t>{0, 1});
  const std::vector<Vec3> few{{1, 1, 1}, {0, 0, 0}, {1, 1, 1}, {0, 0, 1e-9}, {1, 0, 0}, {0, 1, 0}};
  CHECK(curve_order(few) == std::vector<std::uint32_t>{1, 3, 4, 5, 0, 2});
  // 1023 / 5e-324 and 1e308 + 1e308 are infinite.
  for (const double size : {5e-324, 1e-310, 1e-305, 1e-300, 1e300, 1e308}) {
    std::vector<Vec3> points;
    for (const Vec3 p : few) {
      points.push_back(size * (p - Vec3{0.0, 1.0, 0.0}));
      points.push_back(-points.back());
    }
    CHECK(has_each_once(curve_order(points), points.size()));
  }
}

}  // namespace ridgecraft

using namespace ridgecraft;

namespace {

template <class Before>
std::vector<std::uint32_t> sorted_by(const std::vector<float>& numbers, Before before) {
  std::vector<std::uint32_t> order(numbers.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return before(numbers[a], numbers[b]); });
  return order;
}

}  // namespace

TEST_CASE("numbers in order are those of a stable sort, few and many", "[float_order]") {
  Random random(7);
  for (const std::size_t count : {0U, 1U, 2U, 100U, 1023U, 1024U, 20000U}) {
    std::vector<float> numbers;
    for (std::size_t i = 0; i < count; ++i) {
      // Many equal ones, zeros of both signs, and all sizes there are.
      const std::uint64_t kind = random.below(4);
      const auto number = static_cast<float>(random.below(50));
      numbers.push_back(kind == 0   ? number
                        : kind == 1 ? number * 1e-39F
                        : kind == 2 ? number * 1e36F
                                    : (number < 25.0F ? -0.0F : std::numeric_limits<float>::infinity()));
    }
    CHECK(ascending_order(numbers) == sorted_by(numbers, std::less<>()));
    CHECK(descending_order(numbers) == sorted_by(numbers, std::greater<>()));
  }
}

namespace ridgecraft {

TEST_CASE("The first point at each place is what looking at all pairs finds") {
  Random random(5);
  for (const std::uint32_t places : {1U, 3U, 40U, 100000U}) {
    std::vector<Vec3> points;
    std::vector<std::uint8_t> counts;
    for (int i = 0; i < 300; ++i) {
      const auto coordinate = [&] { return static_cast<double>(random.below(places)) / 3.0 - 0.0; };
      points.push_back({coordinate(), i % 2 == 0 ? 0.0 : -0.0, coordinate()});
      counts.push_back(random.below(4) > 0 ? 1 : 0);
    }
    const std::vector<std::uint32_t> all = first_at_place(points);
    const std::vector<std::uint32_t> some = first_at_place(points, counts);
    for (std::uint32_t i = 0; i < points.size(); ++i) {
      std::uint32_t first = 0;
      while (points[first] != points[i]) {
        ++first;
      }
      CHECK(all[i] == first);
      std::uint32_t counted = counts[i] == 0 ? i : 0;
      while (points[counted] != points[i] || (counts[counted] == 0 && counted != i)) {
        ++counted;
      }
      CHECK(some[i] == counted);
    }
  }
  CHECK(first_at_place({}).empty());
}

}  // namespace ridgecraft
