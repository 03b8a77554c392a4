// SPDX-License-Identifier: GPL-3.0-or-later
// Walls that are rolled become as round as their rims can be made.
#include "prepare/features/round_rolls.hpp"

#include <cmath>
#include <cstdint>
#include <vector>

#include <catch2/catch.hpp>

#include "prepare/common_models.hpp"
#include "support/shapes.hpp"

using namespace ridgecraft;
using Catch::Detail::Approx;
using mesh::Model;

namespace {

std::size_t rounded(Model& model, prepare::Rolled which = prepare::Rolled::automatic) {
  prepare::SimplifyOptions options;
  options.rolls.which = which;
  return prepare::round_rolls(model, options, {});
}

bool is_closed(const mesh::Surface& surface) {
  for (const EdgeId e : ids<EdgeId>(surface.edge_count())) {
    if (surface.is_border(e)) {
      return false;
    }
  }
  return true;
}

}  // namespace

TEST_CASE("rims of a can become circles of sides that can be glued, and its ends stay flat", "[rolls]") {
  Model can = test::flat_model_of(test::revolve({{0, 0}, {40, 0}, {40, 60}, {0, 60}}, 12));
  const std::size_t added = rounded(can);
  const mesh::Surface& surface = can.surface;
  CHECK(is_closed(surface));
  const prepare::Panels panels = prepare::find_panels(surface);
  CHECK(added > 0);
  CHECK(panels.count() == 12 + added + 2);
  const prepare::Rolls rolls = prepare::find_rolls(surface, panels, {.which = prepare::Rolled::automatic});
  REQUIRE(rolls.rolls.size() == 1);
  CHECK(rolls.rolls[RollId(0)].closed);
  CHECK(rolls.rolls[RollId(0)].rulings.size() == 12 + added);
  for (const Vec3 p : surface.points()) {
    CHECK(std::hypot(p.x, p.y) == Approx(40.0));
  }
  for (const EdgeId e : ids<EdgeId>(surface.edge_count())) {
    CHECK(surface.length(e) >= prepare::SimplifyOptions().short_edge_mm);
  }
  const double side = surface.length(rolls.rolls[RollId(0)].rulings.front());
  CHECK(side == Approx(60.0));
}

TEST_CASE("bands that share a rim get the same points there, and tips stay tips", "[rolls]") {
  Model body = test::flat_model_of(test::revolve({{0, 0}, {30, 0}, {40, 40}, {40, 70}, {0, 120}}, 12));
  REQUIRE(rounded(body) > 0);
  const mesh::Surface& surface = body.surface;
  CHECK(is_closed(surface));
  const prepare::Rolls rolls =
      prepare::find_rolls(surface, prepare::find_panels(surface), {prepare::Rolled::automatic});
  REQUIRE(rolls.rolls.size() == 3);
  for (const prepare::Roll& roll : rolls.rolls) {
    CHECK(roll.rulings.size() == rolls.rolls[RollId(0)].rulings.size());
    CHECK(roll.rulings.size() > 12);
  }
  for (const Vec3 p : surface.points()) {
    const double radius = std::hypot(p.x, p.y);
    CHECK((radius < 1e-9 || std::abs(radius - 30.0) < 1e-9 || std::abs(radius - 40.0) < 1e-9));
  }
}

TEST_CASE("what isn't rolled, and what would get short sides, stays as it is", "[rolls]") {
  Model can = test::flat_model_of(test::revolve({{0, 0}, {40, 0}, {40, 60}, {0, 60}}, 12));
  CHECK(rounded(can, prepare::Rolled::never) == 0);
  Model pen = test::flat_model_of(test::revolve({{0, 0}, {15, 0}, {15, 60}, {0, 60}}, 12));
  CHECK(rounded(pen) == 0);
  Model box = test::flat_model_of(test::scaled(test::cube(), 50.0));
  CHECK(rounded(box) == 0);
}
