// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdint>

#include <catch2/catch.hpp>

#include "base/context.hpp"
#include "base/random.hpp"
#include "unfold/patch/layout.hpp"
#include "unfold/patch/patch.hpp"
#include "unfold/search/circle_tree.hpp"

using namespace ridgecraft;
using unfold::Triangle;

namespace {

__extension__ using Wide = __int128;

struct Whole {
  std::int64_t x = 0;
  std::int64_t y = 0;
};
using WholeTriangle = std::array<Whole, 3>;

/// Coordinates stay below this, so that all products below are exact in 128 bits.
constexpr std::int64_t largest = 1 << 18;

std::int64_t turn(Whole a, Whole b, Whole c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// The exact depth as numerator / sqrt(denominator): the least, over the edges of both, of how deep the
/// other's deepest corner lies inside.
struct ExactDepth {
  Wide numerator = 0;
  Wide denominator = 0;  ///< 0: no edge had a length
  [[nodiscard]] long double value() const {
    return static_cast<long double>(numerator) / std::sqrt(static_cast<long double>(denominator));
  }
  /// numerator / sqrt(denominator), signed and squared, compared by cross-multiplication.
  [[nodiscard]] bool less(const ExactDepth& o) const {
    if ((numerator < 0) != (o.numerator < 0)) {
      return numerator < 0;
    }
    const Wide a = numerator * numerator * o.denominator;
    const Wide b = o.numerator * o.numerator * denominator;
    return numerator < 0 ? a > b : a < b;
  }
};

ExactDepth exact_depth(const WholeTriangle& a, const WholeTriangle& b) {
  ExactDepth least;
  for (const auto& [s, t] : {std::pair(a, b), std::pair(b, a)}) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Whole p = s[k];
      const Whole q = s[(k + 1) % 3];
      const std::int64_t size = (q.x - p.x) * (q.x - p.x) + (q.y - p.y) * (q.y - p.y);
      if (size == 0) {
        continue;
      }
      const std::int64_t deepest = std::max({turn(p, q, t[0]), turn(p, q, t[1]), turn(p, q, t[2])});
      const ExactDepth here{deepest, size};
      if (least.denominator == 0 || here.less(least)) {
        least = here;
      }
    }
  }
  return least;
}

Triangle rounded(const WholeTriangle& t) {
  Triangle r;
  for (std::size_t k = 0; k < 3; ++k) {
    r[k] = {static_cast<double>(t[k].x), static_cast<double>(t[k].y)};
  }
  return r;
}

Whole random_point(Random& random, std::int64_t size) {
  const auto draw = [&] {
    return static_cast<std::int64_t>(random.below(static_cast<std::uint32_t>(2 * size + 1))) - size;
  };
  const std::int64_t x = draw();
  return {x, draw()};
}

WholeTriangle counterclockwise(WholeTriangle t) {
  if (turn(t[0], t[1], t[2]) < 0) {
    std::swap(t[1], t[2]);
  }
  return t;
}

/// Pairs of all the kinds that nets are full of: edge to edge, corner to corner, equal, contained, nearly
/// parallel, slivers, far apart.
std::pair<WholeTriangle, WholeTriangle> draw_pair(Random& random) {
  const std::int64_t size = std::int64_t{1} << (2 + random.below(16));
  const auto point = [&] { return random_point(random, size); };
  const auto near = [&](Whole p) {
    const Whole d = random_point(random, 1);
    return Whole{std::clamp(p.x + d.x, -largest, largest), std::clamp(p.y + d.y, -largest, largest)};
  };
  WholeTriangle a{point(), point(), point()};
  WholeTriangle b{point(), point(), point()};
  switch (random.below(8)) {
    case 0:
      b = {a[1], a[0], b[2]};
      break;  // along one edge
    case 1:
      b[0] = a[0];
      break;  // at one corner
    case 2:
      b = a;
      break;  // equal
    case 3:
      b = {near(a[0]), near(a[1]), near(a[2])};
      break;  // nearly equal
    case 4:
      a[2] = near({(a[0].x + a[1].x) / 2, (a[0].y + a[1].y) / 2});
      break;  // a sliver
    case 5:
      b = {near(a[0]), near(a[1]), b[2]};
      break;  // nearly parallel edges
    case 6:   // a corner on an edge, or nearly
      b[0] = {(a[0].x + a[1].x) / 2, (a[0].y + a[1].y) / 2};
      break;
    default:
      break;
  }
  return {counterclockwise(a), counterclockwise(b)};
}

}  // namespace

TEST_CASE("penetration agrees with exact arithmetic on a million pairs", "[triangle]") {
  Random random(7);
  // The documented bound for coordinates up to 2^18.
  const double bound = static_cast<double>(largest) * 0x1.0p-49;
  int wrong_depth = 0;
  int wrong_answer = 0;
  int wrong_edged = 0;
  int wrong_difference = 0;
  int deep = 0;
  for (int i = 0; i < 1'000'000; ++i) {
    const auto [a, b] = draw_pair(random);
    const ExactDepth exact = exact_depth(a, b);
    if (exact.denominator == 0) {
      continue;
    }
    const auto depth = static_cast<double>(exact.value());
    const Triangle s = rounded(a);
    const Triangle t = rounded(b);
    wrong_depth += std::abs(unfold::penetration(s, t) - depth) > bound ? 1 : 0;
    deep += depth > 0.0 ? 1 : 0;
    for (const double tolerance : {0.0, 1e-7 * static_cast<double>(largest), -0.5}) {
      if (std::abs(depth - tolerance) <= 2.0 * bound) {
        continue;  // within rounding of the limit: either answer is right
      }
      wrong_answer += unfold::overlap(s, t, tolerance) == (depth > tolerance) ? 0 : 1;
      wrong_edged +=
          unfold::overlap(unfold::edged(s), unfold::edged(t), tolerance) == (depth > tolerance) ? 0 : 1;
    }
    // The independent routine, where both have an area: it tells nothing of how far apart triangles are.
    if (turn(a[0], a[1], a[2]) != 0 && turn(b[0], b[1], b[2]) != 0 && depth > 0.0) {
      wrong_difference += std::abs(unfold::depth_by_difference(s, t) - depth) > bound ? 1 : 0;
    }
  }
  CHECK(wrong_depth == 0);
  CHECK(wrong_answer == 0);
  CHECK(wrong_edged == 0);
  CHECK(wrong_difference == 0);
  CHECK(deep > 100'000);
}

TEST_CASE("a sliver with a side of no length is separated by its other sides", "[triangle]") {
  const Triangle needle{{{0, 0}, {10, 0}, {10, 0}}};
  const Triangle above{{{4, 0}, {6, 0}, {5, 3}}};
  const Triangle across{{{4, -1}, {6, -1}, {5, 3}}};
  CHECK(unfold::penetration(needle, above) == Approx(0.0).margin(1e-15));
  CHECK(unfold::penetration(needle, across) == Approx(1.0));
}

TEST_CASE("the check finds every pair that brute force finds", "[check]") {
  Random random(3);
  std::vector<Triangle> triangles;
  for (int i = 0; i < 300; ++i) {
    const Vec2 at{20.0 * random.unit(), 20.0 * random.unit()};
    triangles.push_back(
        {at, at + Vec2{1.0 + random.unit(), random.unit() - 0.5}, at + Vec2{random.unit(), 1.0}});
  }
  // Nets of symmetric models lay faces exactly on others: equal ones, and others with the same middle.
  for (std::size_t i = 0; i < 40; ++i) {
    triangles.push_back(triangles[7 * i]);
  }
  for (const double size : {1.0, 0.5}) {
    triangles.push_back({Vec2{-2.0 * size, -size}, Vec2{2.0 * size, -size}, Vec2{0.0, 2.0 * size}});
  }
  const auto found = unfold::find_overlaps(triangles, 1e-3);
  std::size_t expected = 0;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      expected += unfold::penetration(triangles[i], triangles[j]) > 1e-3 ? 1U : 0U;
    }
  }
  CHECK(found.size() == expected);
  CHECK(expected > 100);
}
