// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers in order by their digits, against a stable sort.
#include "base/float_order.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <vector>

#include <catch2/catch.hpp>

#include "base/random.hpp"

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
