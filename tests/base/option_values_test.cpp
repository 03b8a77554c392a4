// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/option_values.hpp"

#include <catch2/catch.hpp>

using namespace ridgecraft;

TEST_CASE("lengths are read in every unit", "[units]") {
  CHECK(parse_length_mm("150mm") == 150.0);
  CHECK(parse_length_mm("150 mm") == 150.0);
  CHECK(parse_length_mm("150") == 150.0);
  CHECK(parse_length_mm("15cm") == 150.0);
  CHECK(parse_length_mm("0.15m") == 150.0);
  CHECK(*parse_length_mm("6in") == Approx(152.4));
  CHECK(*parse_length_mm("6\"") == Approx(152.4));
  CHECK(*parse_length_mm("1ft") == Approx(304.8));
}

TEST_CASE("what is no length is refused", "[units]") {
  for (const char* text :
       {"", "mm", "0", "0mm", "-5mm", "nan", "inf", "1e400", "5 parsecs", "5mmm", "five", "1,5cm"}) {
    CAPTURE(text);
    CHECK_FALSE(parse_length_mm(text).has_value());
  }
}

TEST_CASE("scales are ratios, factors or percentages", "[units]") {
  CHECK(parse_scale("1:50") == 0.02);
  CHECK(parse_scale("2:1") == 2.0);
  CHECK(parse_scale("0.5") == 0.5);
  CHECK(*parse_scale("30%") == Approx(0.3));
  for (const char* text : {"", "0", "1:0", "0:1", "-1", "1:", ":2", "1:2:3", "half", "nan"}) {
    CAPTURE(text);
    CHECK_FALSE(parse_scale(text).has_value());
  }
}
