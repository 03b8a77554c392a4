// SPDX-License-Identifier: GPL-3.0-or-later
// Narrow faces side by side become fewer and wider ones, and stay flat.
#include "prepare/features/thin_rulings.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <set>
#include <vector>

#include "base/delaunay.hpp"
#include "mesh/mesh.hpp"
#include "mesh/model/surface_distance.hpp"
#include "mesh/repair/loose_faces.hpp"
#include "prepare/panels/regions.hpp"
#include "prepare/panels/remesh_panels.hpp"
#include "prepare/panels/ruled_strips.hpp"
#include "prepare/simplify/simplify.hpp"
#include "support/shapes.hpp"
#include "support/soups.hpp"

using namespace ridgecraft;
using mesh::Model;

namespace {

constexpr double half_turn = std::numbers::pi;

/// Over an outline that runs counterclockwise, with holes that run clockwise, of a height.
Model prism_over(const std::vector<std::vector<Vec2>>& outlines, double height) {
  std::vector<Vec3> points;
  std::vector<std::vector<std::uint32_t>> polygons;
  std::vector<Vec2> flat;
  std::vector<std::array<std::uint32_t, 2>> sides;
  for (const std::vector<Vec2>& outline : outlines) {
    const auto first = static_cast<std::uint32_t>(flat.size());
    const auto count = static_cast<std::uint32_t>(outline.size());
    for (std::uint32_t i = 0; i < count; ++i) {
      flat.push_back(outline[i]);
      sides.push_back({first + i, first + (i + 1) % count});
    }
  }
  const auto all = static_cast<std::uint32_t>(flat.size());
  for (const double z : {0.0, height}) {
    for (const Vec2 p : flat) {
      points.push_back({p.x, p.y, z});
    }
  }
  for (const auto& [a, b] : sides) {
    polygons.push_back({a, b, b + all, a + all});
  }
  const auto caps = triangulate_inside(flat, sides);
  REQUIRE(caps);
  for (const auto& [a, b, c] : *caps) {
    polygons.push_back({a, c, b});
    polygons.push_back({a + all, b + all, c + all});
  }
  Model model = mesh::repair(points, polygons, {}, {});
  prepare::remesh_panels(model, {});
  return model;
}

/// Part of a circle, from one angle to another one.
std::vector<Vec2> arc(Vec2 middle, double radius, double from, double to, int steps) {
  std::vector<Vec2> points;
  for (int i = 0; i <= steps; ++i) {
    const double t = from + (to - from) * i / steps;
    points.push_back(middle + radius * Vec2{std::cos(t), std::sin(t)});
  }
  return points;
}

std::vector<Vec2> circle(Vec2 middle, double radius, int steps, bool clockwise) {
  std::vector<Vec2> points = arc(middle, radius, 0.0, clockwise ? -2.0 * half_turn : 2.0 * half_turn, steps);
  points.pop_back();
  return points;
}

/// A bridge with a round arch of 80 mm, 36 faces along it.
Model bridge() {
  std::vector<Vec2> outline = arc({0, 0}, 40.0, half_turn, 0.0, 36);
  for (const Vec2 p : {Vec2{70, 0}, Vec2{70, 60}, Vec2{-70, 60}, Vec2{-70, 0}}) {
    outline.push_back(p);
  }
  return prism_over({outline}, 50.0);
}

/// Along the height, or within one of the ends.
void check_runs_straight(const mesh::Surface& surface) {
  for (const EdgeId e : ids<EdgeId>(surface.edge_count())) {
    if (std::abs(surface.fold_angle(e)) > 1e-4) {
      const CornerId c = surface.sides(e)[0];
      const Vec3 way = surface.point(surface.vertex(mesh::next(c))) - surface.point(surface.vertex(c));
      CHECK((std::abs(way.z) < 1e-9 || std::hypot(way.x, way.y) < 1e-9));
    }
  }
}

std::set<std::array<long, 3>> rounded_places(const mesh::Surface& surface, Vec3 mirrored = {1, 1, 1}) {
  std::set<std::array<long, 3>> result;
  for (const Vec3 p : surface.points()) {
    result.insert({std::lround(1e6 * p.x * mirrored.x), std::lround(1e6 * p.y * mirrored.y),
                   std::lround(1e6 * p.z * mirrored.z)});
  }
  return result;
}

double moved_at_most(const mesh::Surface& a, const mesh::Surface& b) {
  return mesh::greatest_distance(mesh::SurfaceTree(a, 1.0), mesh::SurfaceTree(b, 1.0), INFINITY, {});
}

std::vector<prepare::RuledStrip> strips_of(const Model& model) {
  const mesh::LooseFaces loose = mesh::take_apart(model);
  const prepare::PanelRegions regions(model.surface, prepare::find_panels(model.surface), loose);
  return prepare::ruled_strips(model.surface, regions, loose);
}

Model with_panels(const mesh::Surface& surface) {
  Model model = test::repaired(test::soup_of(surface));
  prepare::remesh_panels(model, {});
  return model;
}

}  // namespace

TEST_CASE("strips run around prisms, through tiers, to tips and around rings", "[rulings]") {
  const auto column = strips_of(prism_over({circle({0, 0}, 10.0, 24, false)}, 30.0));
  REQUIRE(column.size() == 1);
  CHECK(column[0].round);
  CHECK_FALSE(column[0].loops);
  CHECK(column[0].lines.size() == 24);
  CHECK(column[0].tiers() == 1);

  const auto cone = strips_of(with_panels(test::revolve({{0, 0}, {20, 0}, {12, 20}, {0, 35}}, 16)));
  REQUIRE_FALSE(cone.empty());
  CHECK(cone[0].round);
  CHECK(cone[0].lines.size() == 16);
  CHECK(cone[0].tiers() == 2);
  CHECK(cone[0].lines[0].points.size() == 3);
  const std::uint32_t tip = cone[0].lines[0].points.back();
  const std::uint32_t other = cone[0].lines[0].points.front();
  CHECK(std::all_of(cone[0].lines.begin(), cone[0].lines.end(), [&](const prepare::RulingLine& line) {
    return line.points.back() == tip || line.points.front() == other;
  }));

  std::vector<Vec2> ring = circle({30, 0}, 8.0, 12, false);
  ring.push_back(ring.front());
  const auto torus = strips_of(with_panels(test::revolve(ring, 20)));
  REQUIRE(torus.size() == 2);
  for (const prepare::RuledStrip& strip : torus) {
    CHECK(strip.round);
    CHECK(strip.loops);
    CHECK(strip.lines.size() * strip.tiers() == 240);
    CHECK(strip.lines[0].points.size() == strip.tiers());
  }

  const auto open = strips_of(with_panels(test::revolve({{20, 0}, {20, 30}, {15, 60}}, 18)));
  REQUIRE(open.size() == 2);  // around, and over the ring that faces could go without
  CHECK(open[0].lines.size() + open[1].lines.size() == 21);
}

TEST_CASE("the lines of strips that aren't round lie side by side in order", "[rulings]") {
  // A rounded edge between two walls: 9 faces, so 10 lines, the first and the last of which are the walls'
  // ends.
  std::vector<Vec2> outline = arc({40, 40}, 10.0, 0.0, half_turn / 2, 9);
  for (const Vec2 p : {Vec2{0, 50}, Vec2{0, 0}, Vec2{50, 0}}) {
    outline.push_back(p);
  }
  Model model = prism_over({outline}, 40.0);
  const auto strips = strips_of(model);
  REQUIRE(strips.size() == 1);
  const prepare::RuledStrip& strip = strips[0];
  CHECK(strip.round);
  for (std::size_t i = 0; i < strip.lines.size(); ++i) {
    const auto& a = strip.lines[i].points;
    const auto& b = strip.lines[(i + 1) % strip.lines.size()].points;
    for (std::size_t t = 0; t < a.size(); ++t) {
      const bool beside = std::any_of(model.surface.corners_at(VertexId(a[t])).begin(),
                                      model.surface.corners_at(VertexId(a[t])).end(), [&](CornerId c) {
                                        return model.surface.vertex(mesh::next(c)).value() == b[t] ||
                                               model.surface.vertex(mesh::previous(c)).value() == b[t];
                                      });
      CHECK(beside);
    }
  }
}

TEST_CASE("an arch keeps straight folds, its sides' planes and its mirror plane", "[rulings]") {
  Model model = bridge();
  const mesh::Surface before = model.surface;
  const prepare::SimplifyOptions options;
  const double allowed = 2.8;
  REQUIRE(prepare::thin_rulings(model, options, allowed, {}) > 10);
  test::check_invariants(model.surface);
  check_runs_straight(model.surface);
  CHECK(rounded_places(model.surface) == rounded_places(model.surface, {-1, 1, 1}));
  CHECK(moved_at_most(before, model.surface) <= 0.5 * allowed);
  CHECK(test::volume(model.surface) == Approx(test::volume(before)).epsilon(0.02));
  const prepare::SimplifyReport report = prepare::simplify(model = bridge(), options, {});
  CHECK(report.rulings_removed > 10);
  check_runs_straight(model.surface);
}

TEST_CASE("points that stay are points of the model, and a mirror image is thinned to the mirror image",
          "[rulings]") {
  // Neither the outline nor the arcs have a mirror plane of their own.
  std::vector<Vec2> outline = arc({0, 0}, 35.0, half_turn, 0.3, 41);
  const std::vector<Vec2> corner = arc({60, 50}, 10.0, 0.0, half_turn / 2, 13);
  outline.push_back({70, -3});
  outline.insert(outline.end(), corner.begin(), corner.end());
  outline.push_back({-60, 60});
  outline.push_back({-50, 0});
  std::vector<Vec2> image;
  for (auto p = outline.rbegin(); p != outline.rend(); ++p) {
    image.push_back({-p->x, p->y});
  }
  Model model = prism_over({outline}, 30.0);
  Model mirrored = prism_over({image}, 30.0);
  const auto all = rounded_places(model.surface);
  REQUIRE(prepare::thin_rulings(model, {}, 2.5, {}) > 0);
  REQUIRE(prepare::thin_rulings(mirrored, {}, 2.5, {}) > 0);
  const auto left = rounded_places(model.surface);
  CHECK(left == rounded_places(mirrored.surface, {-1, 1, 1}));
  CHECK(std::includes(all.begin(), all.end(), left.begin(), left.end()));
}

TEST_CASE("a round hole becomes a prism with both mirror planes", "[rulings]") {
  const int sides = GENERATE(20, 24, 32, 36, 48);
  const std::vector<Vec2> plate{{-60, -30}, {60, -30}, {60, 30}, {-60, 30}};
  Model model = prism_over({plate, circle({0, 0}, 12.0, sides, true)}, 25.0);
  const int genus = test::euler(model.surface);
  prepare::SimplifyOptions folded;
  folded.rolls.which = prepare::Rolled::never;
  REQUIRE(prepare::thin_rulings(model, folded, 2.4, {}) > 0);
  check_runs_straight(model.surface);
  CHECK(test::euler(model.surface) == genus);
  CHECK(rounded_places(model.surface) == rounded_places(model.surface, {-1, 1, 1}));
  CHECK(rounded_places(model.surface) == rounded_places(model.surface, {1, -1, 1}));
  CHECK(model.surface.vertex_count() >= 8 + 2 * 6);
}

TEST_CASE("prisms that were made with few sides, and what can be folded, stay as they are", "[rulings]") {
  Model octagon = prism_over({circle({0, 0}, 5.0, 8, false)}, 80.0);
  CHECK(prepare::thin_rulings(octagon, {}, 2.0, {}) == 0);
  Model wide = prism_over({circle({0, 0}, 60.0, 24, false)}, 80.0);
  CHECK(prepare::thin_rulings(wide, {}, 2.0, {}) == 0);
}

TEST_CASE("a thin fin on a finely divided column isn't passed over", "[rulings]") {
  std::vector<Vec2> outline = arc({0, 0}, 30.0, 0.05, 2.0 * half_turn - 0.05, 200);
  outline.push_back({45, -0.5});
  outline.push_back({45, 0.5});
  Model model = prism_over({outline}, 60.0);
  REQUIRE(prepare::thin_rulings(model, {}, 2.0, {}) > 100);
  CHECK(model.surface.bounds().high.x == Approx(45.0));
  check_runs_straight(model.surface);
}

TEST_CASE("materials keep their borders when rulings go", "[rulings]") {
  Model model = bridge();
  const auto is_arch = [&](const mesh::Surface& surface, FaceId f) {
    const Vec3 n = surface.normal(f);
    const auto [a, b, c] = surface.vertices(f);
    const Vec3 middle = (surface.point(a) + surface.point(b) + surface.point(c)) / 3.0;
    return std::abs(n.z) < 0.5 && std::hypot(middle.x, middle.y) < 41.0;
  };
  model.materials.resize(2);
  for (const FaceId f : ids<FaceId>(model.surface.face_count())) {
    model.material.push_back(is_arch(model.surface, f) ? 1U : 0U);
  }
  REQUIRE(prepare::thin_rulings(model, {}, 2.8, {}) > 10);
  for (const FaceId f : ids<FaceId>(model.surface.face_count())) {
    CHECK((model.material[f] == 1) == is_arch(model.surface, f));
  }
}
