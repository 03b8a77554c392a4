// SPDX-License-Identifier: GPL-3.0-or-later
// Walls that go round stay strips, with one seam.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include "support/shapes.hpp"
#include "unfold/energy/bands.hpp"
#include "unfold/nets_checks.hpp"
#include "unfold/pieces/kept_edges.hpp"
#include "unfold/unfold.hpp"

using namespace ridgecraft;
using unfold::EdgeConstraint;
using unfold::EdgeConstraints;
using unfold::Weights;

namespace {

/// Levels of a turned vase, each turned by half a step against the one below, so that its walls are triangles
/// that point up and down by turns; closed by a fan at either end.
mesh::Surface turned_by_halves(const std::vector<Vec2>& levels, std::uint32_t steps) {
  std::vector<Vec3> points;
  const auto count = static_cast<std::uint32_t>(levels.size());
  for (std::uint32_t i = 0; i < count; ++i) {
    for (std::uint32_t k = 0; k < steps; ++k) {
      const double angle = 2.0 * std::numbers::pi * (k + 0.5 * i) / steps;
      points.emplace_back(levels[i].x * std::cos(angle), levels[i].x * std::sin(angle), levels[i].y);
    }
  }
  points.emplace_back(0.0, 0.0, levels.front().y);
  points.emplace_back(0.0, 0.0, levels.back().y);
  std::vector<std::array<VertexId, 3>> faces;
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    faces.push_back({VertexId(a), VertexId(b), VertexId(c)});
  };
  for (std::uint32_t k = 0; k < steps; ++k) {
    const std::uint32_t next = (k + 1) % steps;
    for (std::uint32_t i = 0; i + 1 < count; ++i) {
      add(i * steps + k, i * steps + next, (i + 1) * steps + k);
      add((i + 1) * steps + k, i * steps + next, (i + 1) * steps + next);
    }
    add(count * steps, next, k);
    add(count * steps + 1, (count - 1) * steps + k, (count - 1) * steps + next);
  }
  return mesh::Surface(std::move(points), std::move(faces));
}

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
  const unfold::Bands bands = unfold::find_bands(patch);
  std::vector<std::size_t> cuts(bands.seam_mm.size(), 0);
  for (std::uint32_t side = 0; side < patch.twin.size(); ++side) {
    const EdgeId edge = surface.edge(mesh::corner(patch.face[side / 3], side % 3));
    if (bands.band[side] != no_index && side < patch.twin[side] && nets.use[edge] == unfold::EdgeUse::cut) {
      ++cuts[bands.band[side]];
    }
  }
  return cuts;
}

}  // namespace

TEST_CASE("walls of quads, and of triangles up and down, are cut at one seam", "[bands][pieces]") {
  const mesh::Surface quads = test::revolve({{0, 0}, {30, 0}, {36, 30}, {30, 60}, {20, 80}, {0, 80}}, 12);
  CHECK(count(kept(quads), EdgeConstraint::band) == 3 * 11);
  CHECK(cuts_across(quads) == std::vector<std::size_t>{1, 1, 1});
  const mesh::Surface triangles = turned_by_halves({{27, 0}, {31, 30}, {36, 62}, {31, 94}}, 8);
  CHECK(count(kept(triangles), EdgeConstraint::band) == 3 * 15);
  CHECK(cuts_across(triangles) == std::vector<std::size_t>{1, 1, 1});
}

TEST_CASE("strips are kept however large the model is and however it lies", "[bands]") {
  const mesh::Surface vase = turned_by_halves({{27, 0}, {31, 30}, {36, 62}, {31, 94}}, 8);
  CHECK(kept(test::scaled(vase, 7.0)) == kept(vase));
  std::vector<Vec3> points;
  for (const Vec3 p : vase.points()) {
    points.emplace_back(p.z, 0.6 * p.x - 0.8 * p.y, 0.8 * p.x + 0.6 * p.y);
  }
  std::vector<std::array<VertexId, 3>> faces;
  for (const FaceId f : ids<FaceId>(vase.face_count())) {
    faces.push_back(vase.vertices(f));
  }
  const mesh::Surface surface(std::move(points), std::move(faces));
  CHECK(count(kept(surface), EdgeConstraint::band) == 3 * 15);
}

TEST_CASE("narrow rings, zigzags and ragged strips stay free", "[bands]") {
  // A rim 5 mm high around 18 mm long sides may hang on the disk in flaps.
  CHECK(count(kept(test::revolve({{0, 0}, {35, 0}, {35, 5}, {0, 5}}, 12)), EdgeConstraint::band) == 0);
  // Nearly flat rings of triangles turn their rims at each corner.
  CHECK(count(kept(turned_by_halves({{20, 0}, {40, 2}}, 5)), EdgeConstraint::band) == 0);
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
