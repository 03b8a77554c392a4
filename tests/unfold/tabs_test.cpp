// SPDX-License-Identifier: GPL-3.0-or-later
// Tabs keep all that is promised of them.
#include <cmath>

#include <catch2/catch.hpp>

#include "base/geometry.hpp"
#include "support/flat_panels.hpp"
#include "support/shapes.hpp"
#include "unfold/tabs/place/place_tabs.hpp"
#include "unfold/tabs_checks.hpp"
#include "unfold/tree_nets.hpp"

using namespace ridgecraft;
using mesh::Surface;
using prepare::Panels;
using test::check_tabs;
using test::flat_panels;
using test::panels_first;
using test::with_tabs;
using unfold::Nets;
using unfold::Tab;
using unfold::TabOptions;

namespace {

double usable_share(const Surface& s, const Nets& nets) {
  return static_cast<double>(unfold::tabs_usable(s, nets, {})) / static_cast<double>(nets.joins.size());
}

}  // namespace

TEST_CASE("a cube's net gets a tab as asked on every cut", "[tabs]") {
  const Surface cube = test::scaled(test::cube(), 40.0);
  const Panels panels = flat_panels(cube);
  const test::FoldOrder order = panels_first(cube);
  Nets nets = test::lay_out(cube, order);
  REQUIRE_FALSE(test::faces_overlap(nets));
  REQUIRE(nets.joins.size() == 7);
  nets = with_tabs(cube, panels, nets);
  CHECK(nets.tabs.size() == 7);
  check_tabs(cube, panels, nets, {});
  std::size_t as_asked = 0;
  for (const Tab& tab : nets.tabs) {
    const double area = 0.5 * doubled_area(tab.polygon);
    as_asked += std::abs(area - 175.0) < 1e-6 ? 1U : 0U;
  }
  CHECK(as_asked == 7);
}

TEST_CASE("tabs on nets of convex hulls keep all promises", "[tabs]") {
  std::size_t clean = 0;
  for (std::uint64_t seed = 1; seed <= 24; ++seed) {
    const double size = seed % 3 == 0 ? 15.0 : seed % 3 == 1 ? 40.0 : 75.0;
    const Surface hull = test::scaled(test::random_hull(10 + 2 * static_cast<int>(seed), seed), size);
    Nets nets = test::lay_out(hull, test::steepest_edge(hull, seed));
    if (test::faces_overlap(nets)) {
      continue;
    }
    ++clean;
    const Panels panels = flat_panels(hull);
    nets = with_tabs(hull, panels, nets);
    INFO("seed " << seed);
    check_tabs(hull, panels, nets, {});
    CHECK(usable_share(hull, nets) > (size > 50.0 ? 0.7 : 0.0));
  }
  CHECK(clean >= 16);
}

TEST_CASE("random trees with several pieces keep all promises", "[tabs]") {
  // Faces of different pieces lie on each other in the plane, and needn't be kept apart.
  const Surface ball = test::scaled(test::sphere(14, 8), 60.0);
  const Panels panels = flat_panels(ball);
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const test::FoldOrder order = test::random_order(ball, seed);
    std::vector<EdgeId> cuts(order.end() - 90, order.end());
    const Nets nets = test::lay_out(ball, order, cuts);
    if (test::faces_overlap(nets)) {
      continue;
    }
    CHECK(nets.pieces.size() > 1);
    check_tabs(ball, panels, with_tabs(ball, panels, nets), {});
  }
}

TEST_CASE("open shapes get no tab at their borders", "[tabs]") {
  const Surface tube = test::scaled(test::revolve({{1, 0}, {1, 1}}, 12), 30.0);
  const Panels panels = flat_panels(tube);
  const Nets nets = with_tabs(tube, panels, test::lay_out(tube, test::breadth_first(tube)));
  CHECK(nets.joins.size() == 1);
  CHECK(nets.tabs.size() == 1);
  check_tabs(tube, panels, nets, {});
}

TEST_CASE("a tab stays within the angles of the face behind which it is glued", "[tabs]") {
  // A flat pyramid with a square base: its sides are triangles with small angles at the base.
  const double height = GENERATE(4.0, 10.0, 40.0);
  std::vector<Vec3> points{{0, 0, 0}, {60, 0, 0}, {60, 40, 0}, {0, 40, 0}, {20, 15, height}};
  const auto v = [](int i) { return VertexId(i); };
  const Surface pyramid(points, {{v(0), v(2), v(1)},
                                 {v(0), v(3), v(2)},
                                 {v(0), v(1), v(4)},
                                 {v(1), v(2), v(4)},
                                 {v(2), v(3), v(4)},
                                 {v(3), v(0), v(4)}});
  const Panels panels = flat_panels(pyramid);
  CHECK(panels.count() == 5);
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const Nets nets = test::lay_out(pyramid, test::random_order(pyramid, seed));
    if (!test::faces_overlap(nets)) {
      const Nets done = with_tabs(pyramid, panels, nets);
      check_tabs(pyramid, panels, done, {});
      CHECK(done.tabs.size() >= done.joins.size() - 1);
    }
  }
}

TEST_CASE("long thin triangles", "[tabs]") {
  // A needle: a pyramid 120 mm high over a triangle of 6 mm.
  const std::vector<Vec3> points{{0, 0, 0}, {6, 0, 0}, {2, 5, 0}, {3, 2, 120}};
  const auto v = [](int i) { return VertexId(i); };
  const Surface needle(points,
                       {{v(0), v(2), v(1)}, {v(0), v(1), v(3)}, {v(1), v(2), v(3)}, {v(2), v(0), v(3)}});
  const Panels panels = flat_panels(needle);
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const Nets nets = test::lay_out(needle, test::random_order(needle, seed));
    if (!test::faces_overlap(nets)) {
      check_tabs(needle, panels, with_tabs(needle, panels, nets), {});
    }
  }
}

TEST_CASE("turning a piece in its plane turns its tabs", "[tabs]") {
  const Surface hull = test::scaled(test::random_hull(40, 7), 50.0);
  const Panels panels = flat_panels(hull);
  Nets nets = test::lay_out(hull, test::steepest_edge(hull, 7));
  REQUIRE_FALSE(test::faces_overlap(nets));
  const Nets before = with_tabs(hull, panels, nets);
  for (const double angle : {0.3, 1.7, 4.0}) {
    Nets turned = nets;
    const auto turn = [&](Vec2 p) {
      return Vec2{std::cos(angle) * p.x - std::sin(angle) * p.y + 100.0,
                  std::sin(angle) * p.x + std::cos(angle) * p.y - 20.0};
    };
    for (auto& corners : turned.flat) {
      for (Vec2& p : corners) {
        p = turn(p);
      }
    }
    const Nets after = with_tabs(hull, panels, turned);
    REQUIRE(after.tabs.size() == before.tabs.size());
    for (const TabId t : ids<TabId>(before.tabs.size())) {
      REQUIRE(after.tabs[t].side == before.tabs[t].side);
      REQUIRE(after.tabs[t].polygon.size() == before.tabs[t].polygon.size());
      for (std::size_t i = 0; i < before.tabs[t].polygon.size(); ++i) {
        // Where two ways to trim a tab leave nearly as much, rounding decides between them.
        CHECK(length(after.tabs[t].polygon[i] - turn(before.tabs[t].polygon[i])) < 0.3);
      }
    }
  }
}

TEST_CASE("other sizes of tabs are kept to", "[tabs]") {
  const Surface hull = test::scaled(test::random_hull(30, 3), 60.0);
  const Panels panels = flat_panels(hull);
  Nets nets = test::lay_out(hull, test::steepest_edge(hull, 3));
  REQUIRE_FALSE(test::faces_overlap(nets));
  TabOptions options;
  options.height_mm = GENERATE(2.0, 3.0, 8.0);
  options.angle = GENERATE(0.6, 1.0);
  options.clearance_mm = GENERATE(0.0, 0.5);
  const Nets done = with_tabs(hull, panels, nets, options);
  CHECK(done.tabs.size() > done.joins.size() / 2);
  check_tabs(hull, panels, done, options);
}
