// SPDX-License-Identifier: GPL-3.0-or-later
#include <span>
#include <utility>

#include <catch2/catch.hpp>

#include "base/random.hpp"
#include "unfold/net/options.hpp"
#include "unfold/tabs/shape/convex_shape.hpp"
#include "unfold/tabs/shape/shapes.hpp"

using namespace ridgecraft;
using unfold::ConvexShape;
using unfold::keeps_clear;

TEST_CASE("things that share a corner are asked for the clearance above the corner zone only",
          "[clearance]") {
  double whole = 0.0;
  double upper = 0.0;
  const auto whole_apart = [&](double least) { return whole >= least; };
  const auto upper_apart = [&](double least) { return upper >= least; };
  whole = 0.1;
  CHECK_FALSE(keeps_clear(false, 0.2, whole_apart, upper_apart));
  CHECK_FALSE(keeps_clear(true, 0.2, whole_apart, upper_apart));
  upper = 0.3;
  CHECK_FALSE(keeps_clear(false, 0.2, whole_apart, upper_apart));
  CHECK(keeps_clear(true, 0.2, whole_apart, upper_apart));
  // They may touch, rounding included, but not overlap.
  whole = -0.5 * unfold::touching_mm;
  CHECK(keeps_clear(true, 0.2, whole_apart, upper_apart));
  whole = -2.0 * unfold::touching_mm;
  CHECK_FALSE(keeps_clear(true, 0.2, whole_apart, upper_apart));
  whole = 0.3;
  upper = 0.0;
  CHECK(keeps_clear(false, 0.2, whole_apart, upper_apart));
}

TEST_CASE("what the search calls clear of a face is clear for the tabs of the result", "[clearance]") {
  // Less by rounding: the two forms compute the same distances in another order.
  constexpr double rounding_mm = 1e-9;
  const unfold::TabOptions options;
  Random random(3);
  int clear = 0;
  int close = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const double edge = 5.0 + 25.0 * random.unit();
    const auto tabs = unfold::tab_candidates(unfold::widest_tab(edge, options), edge, options);
    REQUIRE_FALSE(tabs.empty());
    const bool left = random.below(3) == 0;
    const auto corner = [&] { return Vec2{edge * (1.6 * random.unit() - 0.3), 8.0 * random.unit() - 2.0}; };
    unfold::Walled<3> face;
    face.corner = {left ? Vec2{} : corner(), corner(), corner()};
    const Vec2 a = face.corner[1] - face.corner[0];
    const Vec2 b = face.corner[2] - face.corner[0];
    if (cross(a, b) < 0.0) {
      std::swap(face.corner[1], face.corner[2]);
    }
    face.build_walls();
    const ConvexShape shape(std::span<const Vec2>(face.corner));
    for (const unfold::TabCandidate& tab : tabs) {
      const bool share = left && tab.at_left;
      const bool quick = keeps_clear(
          share, options.clearance_mm, [&](double least) { return walls_apart(tab.whole, face, least); },
          [&](double least) { return walls_apart(tab.upper, face, least); });
      const bool exact =
          clear_of(ConvexShape(std::span<const Vec2>(tab.whole.corner)),
                   {shape, unfold::kind_sharing(share, false)}, options.clearance_mm - rounding_mm);
      clear += quick ? 1 : 0;
      close += exact && !quick ? 1 : 0;
      CHECK((exact || !quick));
    }
  }
  // Both answers came up, and the exact one allows more.
  CHECK(clear > 100);
  CHECK(close > 0);
}
