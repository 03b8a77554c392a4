// SPDX-License-Identifier: GPL-3.0-or-later
// Walls that go round stay strips, with one seam.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include "prepare/prepared/rolls.hpp"
#include "support/shapes.hpp"
#include "unfold/nets_checks.hpp"
#include "unfold/pieces/bands.hpp"
#include "unfold/pieces/kept_edges.hpp"
#include "unfold/unfold.hpp"

using namespace ridgecraft;
using unfold::EdgeConstraint;
using unfold::EdgeConstraints;
using unfold::Weights;

namespace {

/// How many edges have each constraint.
std::size_t count(const EdgeConstraints& constraints, EdgeConstraint constraint) {
  return static_cast<std::size_t>(std::count(constraints.begin(), constraints.end(), constraint));
}

EdgeConstraints kept(const mesh::Surface& surface, const EdgeConstraints& constraints = {}) {
  unfold::Options options;
  options.pieces = unfold::rules_of(unfold::PieceMode::parts);
  options.constraints = constraints;
  const prepare::Panels panels = prepare::find_panels(surface);
  const IdVector<FaceId, PartId> part = test::one_part(surface);
  return unfold::with_bands_kept({surface, panels, part, options},
                                 unfold::find_symmetry(surface, Weights(), Context()));
}

/// Per band of a surface, how many of its rungs are cut in its nets.
std::vector<std::size_t> cuts_across(const mesh::Surface& surface) {
  unfold::Options options = test::on_sheet(190.0, 277.0);
  options.pieces = unfold::rules_of(unfold::PieceMode::parts);
  const prepare::Panels panels = prepare::find_panels(surface);
  const unfold::Nets nets = unfold::unfold(surface, panels, test::one_part(surface), options, Context());
  const unfold::Patch patch = test::whole_patch(surface, panels);
  std::vector<std::size_t> cuts;
  for (const unfold::Band& band : unfold::find_bands(patch)) {
    cuts.push_back(
        static_cast<std::size_t>(std::count_if(band.rungs.begin(), band.rungs.end(), [&](std::uint32_t side) {
          const EdgeId edge = surface.edge(mesh::corner(patch.face[side / 3], side % 3));
          return nets.use[edge] == unfold::EdgeUse::cut;
        })));
  }
  return cuts;
}

/// A vase of walls with twelve sides between two disks.
mesh::Surface turned_vase() {
  return test::revolve({{0, 0}, {30, 0}, {36, 30}, {30, 60}, {20, 80}, {0, 80}}, 12);
}

}  // namespace

TEST_CASE("walls are cut at one seam", "[bands][pieces]") {
  CHECK(count(kept(turned_vase()), EdgeConstraint::band) == 3 * 11);
  CHECK(cuts_across(turned_vase()) == std::vector<std::size_t>{1, 1, 1});
}

TEST_CASE("strips are kept however large the model is and however it lies", "[bands]") {
  CHECK(kept(test::scaled(turned_vase(), 7.0)) == kept(turned_vase()));
  const mesh::Surface upright = turned_vase();
  std::vector<Vec3> points;
  for (const Vec3 p : upright.points()) {
    points.emplace_back(p.z, 0.6 * p.x - 0.8 * p.y, 0.8 * p.x + 0.6 * p.y);
  }
  std::vector<std::array<VertexId, 3>> faces;
  for (const FaceId f : ids<FaceId>(upright.face_count())) {
    faces.push_back(upright.vertices(f));
  }
  const mesh::Surface surface(std::move(points), std::move(faces));
  CHECK(count(kept(surface), EdgeConstraint::band) == 3 * 11);
}

TEST_CASE("narrow rings stay free", "[bands]") {
  // A rim 5 mm high around 18 mm long sides may hang on the disk in flaps.
  CHECK(count(kept(test::revolve({{0, 0}, {35, 0}, {35, 5}, {0, 5}}, 12)), EdgeConstraint::band) == 0);
}

TEST_CASE("a constraint for a rung, or a border of labels across a wall, leaves the wall as it is",
          "[bands]") {
  const mesh::Surface tube = test::revolve({{0, 0}, {10, 0}, {10, 40}, {0, 40}}, 8);
  const EdgeConstraints strip = kept(tube);
  REQUIRE(count(strip, EdgeConstraint::band) == 7);
  const auto rung = std::find(strip.begin(), strip.end(), EdgeConstraint::band) - strip.begin();
  for (const EdgeConstraint constraint : {EdgeConstraint::cut, EdgeConstraint::keep}) {
    EdgeConstraints asked(tube.edge_count(), EdgeConstraint::none);
    asked[EdgeId(static_cast<std::uint32_t>(rung))] = constraint;
    const EdgeConstraints both = kept(tube, asked);
    CHECK(both[EdgeId(static_cast<std::uint32_t>(rung))] == constraint);
    // What is cut is the seam, then; beside what is kept the others are.
    CHECK(count(both, EdgeConstraint::band) == (constraint == EdgeConstraint::cut ? 7 : 6));
  }
  const prepare::Panels panels = prepare::find_panels(tube);
  unfold::Options options;
  options.pieces = unfold::rules_of(unfold::PieceMode::parts);
  for (const FaceId f : ids<FaceId>(tube.face_count())) {
    const auto [a, b, c] = tube.vertices(f);
    options.labels.push_back((tube.point(a) + tube.point(b) + tube.point(c)).x > 0.0 ? 1 : 0);
  }
  const IdVector<FaceId, PartId> part = test::one_part(tube);
  CHECK(count(unfold::with_bands_kept({tube, panels, part, options}, {}), EdgeConstraint::band) == 0);
}

TEST_CASE("a wall that is rolled is one strip, be it of several colours", "[bands]") {
  const mesh::Surface can = test::revolve({{0, 0}, {20, 0}, {20, 40}, {0, 40}}, 16);
  const prepare::Panels panels = prepare::find_panels(can);
  unfold::Options options;
  options.pieces = unfold::rules_of(unfold::PieceMode::parts);
  for (const FaceId f : ids<FaceId>(can.face_count())) {
    options.labels.push_back(panels.panel[f].value() % 2);
  }
  const IdVector<FaceId, PartId> part = test::one_part(can);
  const auto strips = [&] {
    return count(unfold::with_bands_kept({can, panels, part, options}, {}), EdgeConstraint::band);
  };
  CHECK(strips() == 0);
  options.rolls = prepare::find_rolls(can, panels, {}).of_edge;
  CHECK(strips() == 15);
}
