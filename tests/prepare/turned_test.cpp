// SPDX-License-Identifier: GPL-3.0-or-later
// Turned bodies get fewer sides, evenly around.
#include "prepare/features/turned.hpp"

#include <cmath>
#include <map>
#include <numbers>
#include <vector>

#include "mesh/model/surface_distance.hpp"
#include "prepare/panels/remesh_panels.hpp"
#include "prepare/simplify/simplify.hpp"
#include "prepare/walls/fold_figures.hpp"
#include "support/shapes.hpp"
#include "support/soups.hpp"

using namespace ridgecraft;
using mesh::Model;

namespace {

/// Turned into any position.
Model lying(const mesh::Surface& upright, double a, double b, Vec3 shift) {
  mesh::Soup s = test::soup_of(upright);
  for (Vec3& p : s.points) {
    p = {p.x * std::cos(a) - p.y * std::sin(a), p.x * std::sin(a) + p.y * std::cos(a), p.z};
    p = Vec3{p.x, p.y * std::cos(b) - p.z * std::sin(b), p.y * std::sin(b) + p.z * std::cos(b)} + shift;
  }
  Model model = test::repaired(std::move(s));
  prepare::remesh_panels(model, {});
  return model;
}

/// How many points lie at each distance from the mean of all points, in steps of a hundredth of a
/// millimetre.
std::map<long, int> points_by_distance(const mesh::Surface& surface) {
  Vec3 middle;
  for (const Vec3 p : surface.points()) {
    middle += p / static_cast<double>(surface.vertex_count());
  }
  std::map<long, int> count;
  for (const Vec3 p : surface.points()) {
    ++count[std::lround(100.0 * length(p - middle))];
  }
  return count;
}

double greatest_move(const mesh::Surface& a, const mesh::Surface& b) {
  return mesh::greatest_distance(mesh::SurfaceTree(a, 1.0), mesh::SurfaceTree(b, 1.0), INFINITY, {});
}

}  // namespace

TEST_CASE("cylinders, cones, vases and rings become regular prisms of their kind", "[turned]") {
  const int sides = GENERATE(48, 64, 90, 201);
  const double r = 22.0;
  std::vector<Vec2> vase;
  for (int i = 0; i <= 24; ++i) {
    vase.push_back({14.0 + 8.0 * std::sin(0.25 * i), 5.0 * i});
  }
  std::vector<Vec2> closed_vase = vase;
  closed_vase.insert(closed_vase.begin(), {0, 0});
  closed_vase.push_back({0, 120});
  std::vector<Vec2> ring;
  for (int i = 0; i <= 20; ++i) {
    const double t = 2.0 * std::numbers::pi * (i % 20) / 20;
    ring.push_back({50.0 + 14.0 * std::cos(t), 14.0 * std::sin(t)});
  }
  const std::vector<std::vector<Vec2>> profiles{
      {{0, 0}, {r, 0}, {r, 140}, {0, 140}},
      {{0, 0}, {r, 0}, {0, 120}},
      vase,
      closed_vase,
      {{0, -75}, {18, -75}, {18, -10}, {24, 0}, {18, 10}, {18, 75}, {0, 75}},
      ring};
  for (std::size_t k = 0; k < profiles.size(); ++k) {
    for (const double turn : {0.0, 0.7}) {
      INFO("profile " << k << ", " << sides << " sides, turned by " << turn);
      const mesh::Surface upright = test::revolve(profiles[k], sides);
      Model model = lying(upright, turn, 2.0 * turn, {30.0 * turn, 5.0, 0.0});
      const mesh::Surface before = model.surface;
      const prepare::SimplifyOptions options;
      const double allowed = 0.02 * before.bounds().largest_extent();
      REQUIRE(prepare::fold_figures(before, options).brief_share() > options.short_edge_share);
      REQUIRE(prepare::simplify_turned(model, options, allowed, {}) == 1);
      test::check_invariants(model.surface);
      CHECK(model.surface.face_count() < before.face_count());
      CHECK(prepare::fold_figures(model.surface, options).brief_share() <= options.short_edge_share);
      CHECK(greatest_move(before, model.surface) <= allowed);
      CHECK(test::euler(model.surface) == test::euler(before));
      CHECK((test::border_edges(model.surface) > 0) == (test::border_edges(before) > 0));
      const double volume = test::volume(before);
      CHECK(test::volume(model.surface) == Approx(volume).epsilon(0.2));
      // What stands at one distance from the mean of all points, which lies on the axis, are whole rings.
      std::size_t corners = 0;
      for (const auto& [distance, count] : points_by_distance(model.surface)) {
        corners = corners == 0 && count > 2 ? static_cast<std::size_t>(count) : corners;
      }
      REQUIRE(corners >= 6);
      CHECK(model.surface.bounds().largest_extent() > 0.9 * before.bounds().largest_extent());
    }
  }
}

TEST_CASE("rings of a simplified column are regular to the last digit", "[turned]") {
  Model model = lying(test::revolve({{0, 0}, {20, 0}, {20, 140}, {0, 140}}, 64), 0.0, 0.0, {});
  const prepare::SimplifyReport report = prepare::simplify(model, {}, {});
  CHECK(report.turned == 1);
  const std::size_t sides = model.surface.vertex_count() / 2;
  CHECK(sides >= 8);
  CHECK(sides % 4 == 0);
  // All vertical edges are 140 long, all others equally long.
  std::map<long, int> lengths;
  for (const EdgeId e : ids<EdgeId>(model.surface.edge_count())) {
    if (std::abs(model.surface.fold_angle(e)) > 0.01) {
      ++lengths[std::lround(1e6 * model.surface.length(e))];
    }
  }
  CHECK(lengths.size() == 2);
  CHECK(report.deviation_mm <= 2.8);
  CHECK(report.deviation_mm > 0.0);
}

TEST_CASE("what wasn't turned, or needs no change, stays as it is", "[turned]") {
  const prepare::SimplifyOptions options;
  // One point is off its ring.
  mesh::Soup dented = test::soup_of(test::revolve({{0, 0}, {20, 0}, {20, 140}, {0, 140}}, 64));
  dented.points[10] = 0.9 * dented.points[10];
  Model model = test::repaired(std::move(dented));
  CHECK(prepare::simplify_turned(model, options, 3.0, {}) == 0);
  // Few sides are meant.
  for (const int sides : {6, 8}) {
    Model prism = lying(test::revolve({{0, 0}, {20, 0}, {20, 140}, {0, 140}}, sides), 0.3, 0.2, {});
    CHECK(prepare::simplify_turned(prism, options, 3.0, {}) == 0);
  }
  // A column thick enough to be folded.
  Model thick = lying(test::revolve({{0, 0}, {60, 0}, {60, 140}, {0, 140}}, 20), 0.3, 0.2, {});
  CHECK(prepare::simplify_turned(thick, options, 3.0, {}) == 0);
  // A needle can't be: it stays for others to judge.
  Model needle = lying(test::revolve({{0, 0}, {1, 0}, {1, 140}, {0, 140}}, 64), 0.0, 0.0, {});
  CHECK(prepare::simplify_turned(needle, options, 0.01, {}) == 0);
}

TEST_CASE("materials of a turned body end where they ended", "[turned]") {
  mesh::Soup s =
      test::soup_of(test::revolve({{0, 0}, {20, 0}, {20, 50}, {20.2, 100}, {20, 140}, {0, 140}}, 64));
  s.materials.resize(2);
  for (std::size_t i = 0; i < s.polygon_count(); ++i) {
    double height = 0.0;
    for (const std::uint32_t p : s.polygon(i)) {
      height += s.points[p].z / 3.0;
    }
    s.polygon_material.push_back(height < 50.0 ? 0 : 1);
  }
  Model model = test::repaired(std::move(s));
  prepare::remesh_panels(model, {});
  REQUIRE(prepare::simplify_turned(model, {}, 2.8, {}) == 1);
  for (const FaceId f : ids<FaceId>(model.surface.face_count())) {
    const auto [a, b, c] = model.surface.vertices(f);
    const double height =
        (model.surface.point(a).z + model.surface.point(b).z + model.surface.point(c).z) / 3.0;
    CHECK(model.material[f] == (height < 50.0 ? 0U : 1U));
  }
}
