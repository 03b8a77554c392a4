// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/formats/text_file.hpp"

#include <cmath>
#include <string>

#include <catch2/catch.hpp>

#include "base/random.hpp"

using namespace ridgecraft;

TEST_CASE("numbers have the four decimals that they are nearest to, halves and huge ones, too") {
  const auto check = [](double value) {
    const std::string exact = fmt::format("{:.4f}", value);
    REQUIRE(export_::four_decimals(value) == (exact == "-0.0000" ? "0.0000" : exact));
  };
  Random random(3);
  for (int i = 0; i < 100000; ++i) {
    const double size = std::pow(10.0, static_cast<double>(random.below(18)) - 6.0);
    check((2.0 * random.unit() - 1.0) * size);
    const double half = (static_cast<double>(random.below(2000000)) - 1000000.0) / 20000.0;
    check(half);
    check(std::nextafter(half, 1e9));
    check(std::nextafter(half, -1e9));
  }
  for (const double value : {0.0, -0.0, 0.00005, -0.00005, 0.00004, -0.00004, 9.99995, 1e300, -1e300}) {
    check(value);
  }
  CHECK(export_::decimals(-0.00001) == "0");
  CHECK(export_::decimals(12.5) == "12.5");
  CHECK(export_::decimals(-300.0) == "-300");
}
