// SPDX-License-Identifier: GPL-3.0-or-later
// Which strips of flat regions are found to go round.
#include "unfold/pieces/bands.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "support/shapes.hpp"
#include "unfold/nets_checks.hpp"

using namespace ridgecraft;

namespace {

std::vector<unfold::Band> bands_of(const mesh::Surface& surface) {
  return unfold::find_bands(test::whole_patch(surface, prepare::find_panels(surface)));
}

/// How many edges are rungs of each band.
std::vector<std::size_t> rungs_of(const std::vector<unfold::Band>& bands) {
  std::vector<std::size_t> count;
  for (const unfold::Band& band : bands) {
    count.push_back(band.rungs.size());
  }
  return count;
}

double chord(double radius, int steps) {
  return 2.0 * radius * std::sin(std::numbers::pi / steps);
}

}  // namespace

TEST_CASE("the walls of a turned body are bands, its ends and cones are none", "[bands]") {
  // A disk, a wall that widens, a straight one, and a cone.
  const auto bands = bands_of(test::revolve({{0, 0}, {10, 0}, {15, 30}, {15, 50}, {0, 70}}, 9));
  CHECK(rungs_of(bands) == std::vector<std::size_t>{9, 9});
  CHECK(bands[0].mean_rung_mm == Approx(std::hypot(5.0, 30.0)));
  CHECK(bands[1].mean_rung_mm == Approx(20.0));
}

TEST_CASE("a wall of fewer than five regions is none", "[bands]") {
  const std::vector<Vec2> prism{{0, 0}, {10, 0}, {10, 40}, {0, 40}};
  CHECK(bands_of(test::cube()).empty());
  CHECK(bands_of(test::revolve(prism, 4)).empty());
  CHECK(rungs_of(bands_of(test::revolve(prism, 5))) == std::vector<std::size_t>{5});
}

TEST_CASE("a wall that is open at both ends is one, and one with a slit, too", "[bands]") {
  const mesh::Surface tube = test::revolve({{10, 0}, {10, 40}}, 8);
  CHECK(rungs_of(bands_of(tube)) == std::vector<std::size_t>{8});
  const prepare::Panels panels = prepare::find_panels(tube);
  std::vector<FaceId> faces;
  for (const FaceId f : ids<FaceId>(tube.face_count())) {
    if (panels.panel[f] != panels.panel[FaceId(0)]) {
      faces.push_back(f);
    }
  }
  REQUIRE(faces.size() == 14);
  const std::vector<unfold::Band> slit = unfold::find_bands(unfold::make_patch(tube, panels, faces));
  CHECK(rungs_of(slit) == std::vector<std::size_t>{6});
  CHECK(!slit[0].closed);
  CHECK(bands_of(tube)[0].closed);
  // Half a tube goes round, less doesn't.
  const auto share = [&](std::size_t regions) {
    std::vector<FaceId> some;
    for (const FaceId f : ids<FaceId>(tube.face_count())) {
      if (panels.panel[f].value() < regions) {
        some.push_back(f);
      }
    }
    return unfold::find_bands(unfold::make_patch(tube, panels, some));
  };
  CHECK(!share(5).empty());
  CHECK(share(4).empty());
}

TEST_CASE("of bands that cross the one with the longer rungs counts, and each region once", "[bands]") {
  // A tyre: six flat regions around its section, twenty along it.
  std::vector<Vec2> section;
  for (int k = 0; k <= 6; ++k) {
    const double angle = 2.0 * std::numbers::pi * (k % 6) / 6.0 + 0.2;
    section.emplace_back(30.0 + 12.0 * std::cos(angle), 12.0 * std::sin(angle));
  }
  const auto bands = bands_of(test::revolve(section, 20));
  // Around the section the rungs are chords of the large circle, shorter than the section's sides.
  REQUIRE(chord(30.0, 20) < chord(12.0, 6));
  CHECK(rungs_of(bands) == std::vector<std::size_t>(6, 20));
  for (const unfold::Band& band : bands) {
    CHECK(band.mean_rung_mm == Approx(chord(12.0, 6)));
  }
}

TEST_CASE("bands don't depend on how the model is turned, nor on its size", "[bands]") {
  const mesh::Surface body = test::revolve({{0, 0}, {10, 0}, {15, 30}, {0, 30}}, 12);
  const auto bands = bands_of(body);
  const auto larger = bands_of(test::scaled(body, 10.0));
  REQUIRE(larger.size() == 1);
  CHECK(larger[0].rungs == bands[0].rungs);
  CHECK(larger[0].mean_rung_mm == Approx(10.0 * bands[0].mean_rung_mm));
}
