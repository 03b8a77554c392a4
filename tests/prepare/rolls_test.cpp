// SPDX-License-Identifier: GPL-3.0-or-later
// Which bands are rolled: those that paper can be wound round something as.
#include "prepare/prepared/rolls.hpp"

#include <cmath>
#include <numbers>
#include <vector>

#include <catch2/catch.hpp>

#include "support/shapes.hpp"

using namespace ridgecraft;
using Catch::Detail::Approx;
using prepare::Rolls;

namespace {

constexpr prepare::RollRules as_needed{.which = prepare::Rolled::automatic};

Rolls rolls_of(const mesh::Surface& surface, const prepare::RollRules& rules = as_needed, double mm = 1.0) {
  return prepare::find_rolls(surface, prepare::find_panels(surface), rules, mm);
}

/// A wall of this height over a line of points, open all round.
mesh::Surface wall_over(const std::vector<Vec2>& line, double height) {
  std::vector<Vec3> points;
  for (const Vec2 p : line) {
    points.emplace_back(p.x, p.y, 0.0);
    points.emplace_back(p.x, p.y, height);
  }
  std::vector<std::array<VertexId, 3>> faces;
  for (std::uint32_t i = 0; i + 1 < line.size(); ++i) {
    const std::uint32_t a = 2 * i;
    faces.push_back({VertexId(a), VertexId(a + 2), VertexId(a + 3)});
    faces.push_back({VertexId(a), VertexId(a + 3), VertexId(a + 1)});
  }
  return mesh::Surface(std::move(points), std::move(faces));
}

}  // namespace

TEST_CASE("walls of cylinders and cones are rolled all the way round", "[rolls]") {
  for (const int sides : {11, 16, 60}) {
    const Rolls can = rolls_of(test::revolve({{0, 0}, {20, 0}, {20, 50}, {0, 50}}, sides));
    REQUIRE(can.rolls.size() == 1);
    const prepare::Roll& wall = can.rolls[RollId(0)];
    CHECK(wall.closed);
    CHECK(wall.rulings.size() == static_cast<std::size_t>(sides));
    CHECK(wall.radii_mm[0] == Approx(20.0).epsilon(0.03));
    CHECK(wall.radii_mm[1] == Approx(wall.radii_mm[0]));
  }
  // A cone is bent across its rulings: with the radius of its rim over the cosine of its slope.
  const Rolls shade = rolls_of(test::revolve({{30, 0}, {15, 20}}, 40));
  REQUIRE(shade.rolls.size() == 1);
  CHECK(shade.rolls[RollId(0)].radii_mm[1] == Approx(30.0 / 0.8).epsilon(0.03));
  CHECK(shade.rolls[RollId(0)].radii_mm[0] == Approx(15.0 / 0.8).epsilon(0.03));
  const Rolls tip = rolls_of(test::revolve({{0, 0}, {30, 0}, {0, 40}}, 24));
  REQUIRE(tip.rolls.size() == 1);
  CHECK(tip.rolls[RollId(0)].closed);
  CHECK(tip.rolls[RollId(0)].radii_mm[0] == Approx(0.0).margin(1e-9));
}

TEST_CASE("polygons, tight walls and what nobody wants rolled are folded", "[rolls]") {
  CHECK(rolls_of(test::cube()).rolls.empty());
  CHECK(rolls_of(test::revolve({{0, 0}, {20, 0}, {20, 50}, {0, 50}}, 10)).rolls.empty());
  const mesh::Surface can = test::revolve({{0, 0}, {20, 0}, {20, 50}, {0, 50}}, 16);
  CHECK(rolls_of(can, {.which = prepare::Rolled::never}).rolls.empty());
  CHECK(rolls_of(can, as_needed, 0.1).rolls.empty());
  const Rolls board = rolls_of(can, {.which = prepare::Rolled::automatic, .least_radius_mm = 30.0});
  CHECK(board.rolls.empty());
  CHECK(board.too_tight == 16);
  // Flaps on a disk are less work than a ring so low.
  const mesh::Surface ring = test::revolve({{0, 0}, {60, 0}, {60, 5}, {0, 5}}, 16);
  CHECK(rolls_of(ring).rolls.empty());
  CHECK(rolls_of(ring, {.which = prepare::Rolled::always}).rolls.size() == 1);
}

TEST_CASE("a strip with two ends is rolled from so many folds on as it costs", "[rolls]") {
  const auto arch = [](int regions) {
    std::vector<Vec2> line;
    for (int i = 0; i <= regions; ++i) {
      const double angle = std::numbers::pi * i / 18.0;
      line.emplace_back(60.0 * std::cos(angle), 60.0 * std::sin(angle));
    }
    return wall_over(line, 80.0);
  };
  CHECK(rolls_of(arch(5)).rolls.empty());
  CHECK(rolls_of(arch(5), {.which = prepare::Rolled::always}).rolls.size() == 1);
  CHECK(rolls_of(arch(6)).rolls.size() == 1);
}

TEST_CASE("a wall that waves is rolled one way, then the other", "[rolls]") {
  std::vector<Vec2> line;
  for (int i = 0; i <= 40; ++i) {
    const double x = 2.0 * std::numbers::pi * i / 40.0;
    line.emplace_back(20.0 * x, 15.0 * std::sin(x + 0.01));
  }
  const mesh::Surface wave = wall_over(line, 80.0);
  const Rolls rolls = rolls_of(wave);
  CHECK(rolls.rolls.size() >= 2);
  std::size_t bends = 0;
  for (const prepare::Roll& roll : rolls.rolls) {
    CHECK_FALSE(roll.closed);
    for (const EdgeId e : roll.rulings) {
      CHECK(wave.fold_angle(e) * wave.fold_angle(roll.rulings.front()) > 0.0);
      CHECK(rolls.bends(e));
      ++bends;
    }
  }
  CHECK(bends >= 36);
}

TEST_CASE("rolls don't depend on the unit, and their radii are those on paper", "[rolls]") {
  const std::vector<Vec2> profile{{0, 0}, {10, 0}, {15, 30}, {15, 50}, {0, 70}};
  const mesh::Surface body = test::revolve(profile, 18);
  const Rolls one = rolls_of(body, as_needed, 3.0);
  const Rolls other = rolls_of(test::scaled(body, 3.0));
  CHECK(one.rolls.size() == 3);
  CHECK(one.of_edge == other.of_edge);
  for (const RollId r : ids<RollId>(one.rolls.size())) {
    CHECK(one.rolls[r].radii_mm[1] == Approx(other.rolls[r].radii_mm[1]));
  }
}

TEST_CASE("each flat region is in one band at most", "[rolls]") {
  for (const auto& surface :
       {test::scaled(test::sphere(32, 16), 60.0), test::scaled(test::sphere(16, 32), 60.0)}) {
    const prepare::Panels panels = prepare::find_panels(surface);
    const Rolls rolls = prepare::find_rolls(surface, panels, {.which = prepare::Rolled::always});
    CHECK(!rolls.rolls.empty());
    IdVector<PanelId, std::size_t> bends(panels.count(), 0);
    for (const EdgeId e : ids<EdgeId>(surface.edge_count())) {
      for (const CornerId side : surface.sides(e)) {
        bends[panels.panel[mesh::face_of(side)]] += rolls.bends(e) ? 1U : 0U;
      }
    }
    for (const std::size_t count : bends) {
      CHECK(count <= 2);
    }
  }
}
