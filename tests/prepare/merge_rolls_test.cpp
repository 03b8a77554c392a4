// SPDX-License-Identifier: GPL-3.0-or-later
// What is round both ways becomes few bands that are rolled.
#include "prepare/features/merge_rolls.hpp"

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include <catch2/catch.hpp>

#include "mesh/model/surface_distance.hpp"
#include "prepare/common_models.hpp"
#include "support/shapes.hpp"

using namespace ridgecraft;
using Catch::Detail::Approx;
using mesh::Model;

namespace {

/// A ball of so many rings and sides; the profile runs from pole to pole.
mesh::Surface ball(double radius_mm, int rings, int sides) {
  std::vector<Vec2> profile;
  for (int i = 0; i <= rings; ++i) {
    const double angle = std::numbers::pi * i / rings;
    const bool pole = i == 0 || i == rings;
    profile.push_back({pole ? 0.0 : radius_mm * std::sin(angle), -radius_mm * std::cos(angle)});
  }
  return test::revolve(profile, sides);
}

std::size_t merged(Model& model, prepare::Rolled which = prepare::Rolled::automatic) {
  prepare::SimplifyOptions options;
  options.rolls.which = which;
  return prepare::merge_rolls(model, options, {});
}

double largest_move(const mesh::Surface& before, const mesh::Surface& after) {
  const double spacing_mm = 1.0;
  return mesh::measured_distance(mesh::SurfaceTree(after, spacing_mm), mesh::SurfaceTree(before, spacing_mm),
                                 {});
}

}  // namespace

TEST_CASE("a ball of fine facets becomes few cones on each other, poles included", "[rolls]") {
  const mesh::Surface before = ball(75.0, 32, 48);
  Model model = test::flat_model_of(before);
  const std::size_t rings = merged(model);
  const prepare::Panels panels = prepare::find_panels(model.surface);
  const prepare::Rolls rolls =
      prepare::find_rolls(model.surface, panels, {.which = prepare::Rolled::automatic});
  CHECK(rolls.rolls.size() == 32 - rings);
  // A band of 22.5 degrees is 1.44 mm off, one of 25 degrees more than the 1.5 mm that rings may move it.
  CHECK(rolls.rolls.size() == 8);
  for (const prepare::Roll& roll : rolls.rolls) {
    CHECK(roll.closed);
    CHECK(roll.rulings.size() == 48);
  }
  CHECK(largest_move(before, model.surface) <= 1.5 + 1e-6);
  for (const EdgeId e : ids<EdgeId>(model.surface.edge_count())) {
    CHECK_FALSE(model.surface.is_border(e));
  }
}

TEST_CASE("a bowl keeps its rims, and creases between bands stay", "[rolls]") {
  // Two cones that meet at 90 degrees, each of three bands in one line, open at both ends.
  Model model = test::flat_model_of(
      test::revolve({{20, 0}, {30, 10.1}, {40, 20}, {50, 30}, {40, 40.1}, {30, 50}, {20, 60}}, 24));
  const Box3 before = model.surface.bounds();
  CHECK(merged(model) == 4);
  const prepare::Rolls rolls = prepare::find_rolls(model.surface, prepare::find_panels(model.surface),
                                                   {.which = prepare::Rolled::automatic});
  CHECK(rolls.rolls.size() == 2);
  CHECK(length(model.surface.bounds().size() - before.size()) == Approx(0.0).margin(1e-9));
}

TEST_CASE("what isn't rolled, or is too small, keeps its rings", "[rolls]") {
  Model ball_model = test::flat_model_of(ball(75.0, 32, 48));
  CHECK(merged(ball_model, prepare::Rolled::never) == 0);
  Model bead = test::flat_model_of(ball(2.5, 16, 24));
  CHECK(merged(bead) == 0);
  Model octagonal = test::flat_model_of(ball(75.0, 32, 8));
  CHECK(merged(octagonal) == 0);
}
