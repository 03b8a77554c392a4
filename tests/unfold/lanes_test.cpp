// SPDX-License-Identifier: GPL-3.0-or-later
// Vectors of the compiler and the portable lanes give the same bits.
#include <bit>
#include <cstdint>
#include <limits>

#include <catch2/catch.hpp>

#include "base/random.hpp"
#include "unfold/search/circle_tree.hpp"

using namespace ridgecraft;
using namespace ridgecraft::unfold;

namespace {

double some_number(Random& random) {
  switch (random.below(8)) {
    case 0:
      return std::numeric_limits<double>::infinity();
    case 1:
      return -0.0;
    case 2:
      return 0.0;
    default:
      return (random.unit() - 0.5) * 1e3;
  }
}

template <typename Lanes, typename Portable>
struct Both {
  Lanes lanes{};
  Portable portable{};
};

template <typename Number, typename Lanes, typename Portable, unsigned count>
Both<Lanes, Portable> some_lanes(Random& random) {
  Both<Lanes, Portable> both;
  for (unsigned k = 0; k < count; ++k) {
    both.lanes[k] = both.portable[k] = static_cast<Number>(some_number(random));
  }
  return both;
}

template <typename Bits, unsigned count>
bool same_bits(const auto& a, const auto& b) {
  for (unsigned k = 0; k < count; ++k) {
    // What isn't a number has no fixed sign.
    if (std::bit_cast<Bits>(a[k]) != std::bit_cast<Bits>(b[k]) && !(a[k] != a[k] && b[k] != b[k])) {
      return false;
    }
  }
  return true;
}

}  // namespace

TEST_CASE("four single numbers at a time are the same as one by one", "[unfold]") {
  Random random(3);
  for (int run = 0; run < 50000; ++run) {
    const auto a = some_lanes<float, FloatLanes, PortableFloatLanes, 4>(random);
    const auto b = some_lanes<float, FloatLanes, PortableFloatLanes, 4>(random);
    const auto c = static_cast<float>(some_number(random));
    REQUIRE(same_bits<std::uint32_t, 4>(a.lanes + b.lanes, a.portable + b.portable));
    REQUIRE(same_bits<std::uint32_t, 4>(a.lanes - c, a.portable - c));
    REQUIRE(same_bits<std::uint32_t, 4>(a.lanes + c, a.portable + c));
    REQUIRE(same_bits<std::uint32_t, 4>(a.lanes * a.lanes + b.lanes * b.lanes,
                                        a.portable * a.portable + b.portable * b.portable));
    REQUIRE(bits_of(a.lanes < b.lanes) == bits_of(a.portable < b.portable));
    REQUIRE(same_bits<std::uint32_t, 4>(smaller(a.lanes, b.lanes), smaller(a.portable, b.portable)));
    REQUIRE(same_bits<std::uint32_t, 4>(larger(a.lanes, b.lanes), larger(a.portable, b.portable)));
  }
}

TEST_CASE("two double numbers at a time are the same as one by one", "[unfold]") {
  Random random(4);
  for (int run = 0; run < 50000; ++run) {
    const auto a = some_lanes<double, DoubleLanes, PortableDoubleLanes, 2>(random);
    const auto b = some_lanes<double, DoubleLanes, PortableDoubleLanes, 2>(random);
    const double c = some_number(random);
    REQUIRE(same_bits<std::uint64_t, 2>(a.lanes * c + b.lanes * c, a.portable * c + b.portable * c));
    REQUIRE(same_bits<std::uint64_t, 2>(c * a.lanes - c * b.lanes, c * a.portable - c * b.portable));
    REQUIRE(same_bits<std::uint64_t, 2>(smaller(a.lanes, b.lanes), smaller(a.portable, b.portable)));
    REQUIRE(same_bits<std::uint64_t, 2>(larger(a.lanes, b.lanes), larger(a.portable, b.portable)));
  }
}
