// SPDX-License-Identifier: GPL-3.0-or-later
// The portable 128-bit integers against the compiler's own.
#include "base/int128.hpp"

#include <array>
#include <compare>
#include <cstdint>
#include <limits>

#include <catch2/catch.hpp>

#include "base/random.hpp"

using namespace ridgecraft;

#ifdef __SIZEOF_INT128__
namespace {

__extension__ using Wide = __int128;

/// The same number in both forms, however many bits it has.
struct Both {
  PortableInt128 portable;
  Wide wide = 0;
};

bool same(const PortableInt128& portable, Wide wide) {
  // Halves of 64 bits, put together again.
  const PortableInt128 high = static_cast<std::int64_t>(wide >> 64);
  const auto low = static_cast<std::uint64_t>(wide);
  const PortableInt128 shift = PortableInt128(std::int64_t{1} << 32) * PortableInt128(std::int64_t{1} << 32);
  return portable ==
         high * shift +
             PortableInt128(static_cast<std::int64_t>(low >> 32)) * PortableInt128(std::int64_t{1} << 32) +
             PortableInt128(static_cast<std::int64_t>(low & 0xffffffff));
}

std::int64_t some_number(Random& random) {
  constexpr std::array<std::int64_t, 9> edges{0,
                                              1,
                                              -1,
                                              0xffffffff,
                                              -0xffffffffLL,
                                              std::int64_t{1} << 32,
                                              -(std::int64_t{1} << 32),
                                              std::numeric_limits<std::int64_t>::max(),
                                              std::numeric_limits<std::int64_t>::min()};
  return random.below(4) == 0 ? edges[random.below(9)]
                              : static_cast<std::int64_t>(random.next()) >> random.below(64);
}

/// A product and a sum: more than 64 bits, and no overflow of the compiler's type, which would be undefined.
Both some_wide(Random& random) {
  const std::int64_t a = some_number(random) / 4;
  const std::int64_t b = some_number(random) / 4;
  const std::int64_t c = some_number(random);
  return {PortableInt128(a) * PortableInt128(b) + PortableInt128(c), Wide{a} * b + c};
}

}  // namespace

TEST_CASE("portable 128-bit integers are the compiler's", "[base]") {
  Random random(7);
  for (int run = 0; run < 200000; ++run) {
    const Both a = some_wide(random);
    const Both b = some_wide(random);
    const std::int64_t c = some_number(random) >> 40;
    REQUIRE(same(a.portable, a.wide));
    REQUIRE(same(a.portable + b.portable, a.wide + b.wide));
    REQUIRE(same(a.portable - b.portable, a.wide - b.wide));
    REQUIRE(same(-a.portable, -a.wide));
    const Both less{a.portable - b.portable, a.wide - b.wide};
    if (less.wide >> 100 == 0 || less.wide >> 100 == -1) {
      REQUIRE(same(less.portable * c, less.wide * c));
      REQUIRE(same(c * less.portable, less.wide * c));
    }
    REQUIRE((a.portable < b.portable) == (a.wide < b.wide));
    REQUIRE((a.portable >= b.portable) == (a.wide >= b.wide));
    REQUIRE((a.portable == b.portable) == (a.wide == b.wide));
    REQUIRE((a.portable > 0) == (a.wide > 0));
    REQUIRE((a.portable == a.portable) == true);
  }
}
#endif

TEST_CASE("128-bit integers hold products of three grid differences", "[base]") {
  const std::int64_t largest = (std::int64_t{1} << 41) - 1;
  const Int128 product = Int128{largest} * Int128{largest} * largest;
  CHECK(product > 0);
  CHECK(product - product == 0);
  CHECK(-product < 0);
  CHECK(product * -1 == -product);
  CHECK(product - Int128{largest} * Int128{largest} * (largest - 1) == Int128{largest} * Int128{largest});
}
