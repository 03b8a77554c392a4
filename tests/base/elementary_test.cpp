// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/elementary.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include <catch2/catch.hpp>

#include "base/encodings.hpp"
#include "base/random.hpp"

using namespace ridgecraft;

namespace {

using Function = double (*)(double);
using Reference = long double (*)(long double);

struct Tested {
  std::string name;
  Function function;
  Reference reference;
  double low, high;  ///< arguments
};

const std::array<Tested, 9> tested{{
    {"sin", elementary::sin, std::sin, -50.0, 50.0},
    {"cos", elementary::cos, std::cos, -50.0, 50.0},
    {"tan", elementary::tan, std::tan, -50.0, 50.0},
    {"asin", elementary::asin, std::asin, -1.0, 1.0},
    {"acos", elementary::acos, std::acos, -1.0, 1.0},
    {"exp2", elementary::exp2, std::exp2, -1000.0, 1000.0},
    {"log", elementary::log, std::log, 1e-300, 1e3},
    {"log2", elementary::log2, std::log2, 1e-300, 1e3},
    {"log10", elementary::log10, std::log10, 1e-300, 1e3},
}};

/// How far apart, in units of the last place of the right value.
double units_off(double value, long double right) {
  const auto near = static_cast<double>(right);
  const double unit =
      std::nextafter(std::abs(near), std::numeric_limits<double>::infinity()) - std::abs(near);
  return static_cast<double>(std::abs(static_cast<long double>(value) - right)) / unit;
}

/// Bits of many values: the same on each machine, or something else than musl was linked.
class Bits {
 public:
  void add(double value) {
    const auto bits = std::bit_cast<std::uint64_t>(value);
    for (unsigned shift = 0; shift < 64; shift += 8) {
      bytes_ += static_cast<char>(static_cast<unsigned char>(bits >> shift));
    }
  }
  [[nodiscard]] std::string digest() const { return ridgecraft::digest(bytes_); }

 private:
  std::string bytes_;
};

}  // namespace

TEST_CASE("elementary functions are right to the last places") {
  Random random(1);
  for (const Tested& t : tested) {
    INFO(t.name);
    double worst = 0.0;
    for (int i = 0; i < 20000; ++i) {
      const double x = t.low + (t.high - t.low) * random.unit();
      worst = std::max(worst, units_off(t.function(x), t.reference(x)));
    }
    CHECK(worst < 1.0);
  }
  double worst = 0.0;
  for (int i = 0; i < 20000; ++i) {
    const double x = 200.0 * random.unit() - 100.0;
    const double y = 200.0 * random.unit() - 100.0;
    worst = std::max({worst, units_off(elementary::atan2(y, x), std::atan2(static_cast<long double>(y), x)),
                      units_off(elementary::hypot(x, y), std::hypot(static_cast<long double>(x), y)),
                      units_off(elementary::pow(std::abs(x), 0.05 * y),
                                std::pow(static_cast<long double>(std::abs(x)), 0.05 * y))});
  }
  CHECK(worst < 2.0);
}

TEST_CASE("elementary functions know the ends of their ranges") {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  CHECK(std::isnan(elementary::asin(1.5)));
  CHECK(std::isnan(elementary::sin(infinity)));
  CHECK(elementary::log(0.0) == -infinity);
  CHECK(elementary::pow(0.0, 0.0) == 1.0);
  CHECK(elementary::pow(0.0, -1.0) == infinity);
  CHECK(std::signbit(elementary::atan2(-0.0, 1.0)));
}

TEST_CASE("elementary functions have the same bits on every machine") {
  Random random(2);
  Bits bits;
  for (const Tested& t : tested) {
    for (int i = 0; i < 2000; ++i) {
      bits.add(t.function(t.low + (t.high - t.low) * random.unit()));
    }
  }
  for (int i = 0; i < 2000; ++i) {
    const double x = 200.0 * random.unit() - 100.0;
    const double y = 200.0 * random.unit() - 100.0;
    bits.add(elementary::atan2(y, x));
    bits.add(elementary::hypot(x, y));
    bits.add(elementary::pow(std::abs(x), 0.05 * y));
  }
  CHECK(bits.digest() == "d98af423c83dcd77");
}
