// SPDX-License-Identifier: GPL-3.0-or-later
// Narrow faces along the edges of walls go as a whole.
#include "prepare/features/sharpen_bevels.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "mesh/mesh.hpp"
#include "prepare/panels/remesh_panels.hpp"
#include "prepare/simplify/simplify.hpp"
#include "support/shapes.hpp"
#include "support/soups.hpp"

using namespace ridgecraft;
using mesh::Model;

namespace {

using PolygonCorners = std::vector<std::vector<std::uint32_t>>;

Model made_of_polygons(const std::vector<Vec3>& points, const PolygonCorners& polygons) {
  Model model = mesh::repair(points, polygons, {}, {});
  prepare::remesh_panels(model, {});
  return model;
}

/// A plate whose upper edges are bevelled all around: its top is smaller by `bevel` on each side. Many
/// notches in its underside make it too fine to be folded as it is.
Model bevelled_plate(Vec3 size, double bevel) {
  const double x = 0.5 * size.x;
  const double y = 0.5 * size.y;
  std::vector<Vec3> points;
  const auto ring = [&](double inset, double z) {
    for (const auto& [sx, sy] : std::array<std::array<double, 2>, 4>{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}}) {
      points.push_back({sx * (x - inset), sy * (y - inset), z});
    }
  };
  ring(0.0, 0.0);
  ring(0.0, size.z - bevel);
  ring(bevel, size.z);
  PolygonCorners polygons{{3, 2, 1, 0}, {8, 9, 10, 11}};
  for (std::uint32_t tier = 0; tier < 2; ++tier) {
    for (std::uint32_t k = 0; k < 4; ++k) {
      const std::uint32_t next = (k + 1) % 4;
      polygons.push_back({4 * tier + k, 4 * tier + next, 4 * (tier + 1) + next, 4 * (tier + 1) + k});
    }
  }
  return made_of_polygons(points, polygons);
}

/// A cuboid of which all edges and corners are cut off. At every second corner its walls end `skew` earlier,
/// which leaves no bevel flat.
Model chamfered(Vec3 half, double bevel, double skew = 0.0) {
  std::vector<Vec3> points;
  PolygonCorners polygons;
  const auto number = [&](Vec3 p) {
    const auto same =
        std::find_if(points.begin(), points.end(), [&](Vec3 q) { return length(p - q) < 1e-9; });
    if (same != points.end()) {
      return static_cast<std::uint32_t>(same - points.begin());
    }
    points.push_back(p);
    return static_cast<std::uint32_t>(points.size() - 1);
  };
  // The corner at (sx, sy, sz) has a point on each of the three walls.
  const auto on_wall = [&](int axis, const std::array<double, 3>& s) {
    const std::array<double, 3> h{half.x, half.y, half.z};
    std::array<double, 3> p{};
    const double more = s[0] * s[1] * s[2] > 0.0 ? skew : 0.0;
    for (int k = 0; k < 3; ++k) {
      const auto i = static_cast<std::size_t>(k);
      p[i] = s[i] * (k == axis ? h[i] : h[i] - bevel - (k == (axis + 1) % 3 ? more : 0.0));
    }
    return number({p[0], p[1], p[2]});
  };
  const auto add = [&](std::vector<std::uint32_t> polygon) {
    Vec3 doubled;
    Vec3 middle;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      doubled += cross(points[polygon[i]], points[polygon[(i + 1) % polygon.size()]]);
      middle += points[polygon[i]];
    }
    if (dot(doubled, middle) < 0.0) {
      std::reverse(polygon.begin(), polygon.end());
    }
    polygons.push_back(polygon);
  };
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    const std::size_t b = (a + 1) % 3;
    const std::size_t c = (a + 2) % 3;
    for (const double side : {-1.0, 1.0}) {
      std::array<double, 3> s{};
      s[a] = side;
      std::vector<std::uint32_t> wall;
      for (const auto& [u, v] : std::array<std::array<double, 2>, 4>{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}}) {
        s[b] = u;
        s[c] = v;
        wall.push_back(on_wall(axis, s));
      }
      add(wall);
    }
    // The four edges along this axis.
    for (const auto& [u, v] : std::array<std::array<double, 2>, 4>{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}}) {
      std::array<double, 3> low{};
      low[a] = -1.0;
      low[b] = u;
      low[c] = v;
      std::array<double, 3> high = low;
      high[a] = 1.0;
      add({on_wall(static_cast<int>(b), low), on_wall(static_cast<int>(b), high),
           on_wall(static_cast<int>(c), high), on_wall(static_cast<int>(c), low)});
    }
  }
  for (int corner = 0; corner < 8; ++corner) {
    const std::array<double, 3> s{corner & 1 ? 1.0 : -1.0, corner & 2 ? 1.0 : -1.0, corner & 4 ? 1.0 : -1.0};
    add({on_wall(0, s), on_wall(1, s), on_wall(2, s)});
  }
  return made_of_polygons(points, polygons);
}

void check_is_box(const mesh::Surface& surface, Vec3 size) {
  test::check_invariants(surface);
  CHECK(surface.vertex_count() == 8);
  CHECK(surface.face_count() == 12);
  CHECK(length(surface.bounds().size() - size) < 1e-9);
  CHECK(test::volume(surface) == Approx(size.x * size.y * size.z));
}

}  // namespace

TEST_CASE("a plate with bevelled upper edges becomes a box", "[bevels]") {
  const double bevel = GENERATE(0.5, 1.5, 2.5);
  Model model = bevelled_plate({120, 60, 10}, bevel);
  CHECK(prepare::sharpen_bevels(model, {}, 2.4, {}) == 4);
  check_is_box(model.surface, {120, 60, 10});
}

TEST_CASE("bevelled corners go with the edges that end there", "[bevels]") {
  Model model = chamfered({60, 30, 20}, 1.5);
  REQUIRE(model.surface.vertex_count() == 24);
  CHECK(prepare::sharpen_bevels(model, {}, 2.4, {}) == 12);
  check_is_box(model.surface, {120, 60, 40});
}

TEST_CASE("bevels that aren't quite flat in the file go, too", "[bevels]") {
  Model model = chamfered({60, 30, 20}, 1.5, 0.2);
  REQUIRE(prepare::find_panels(model.surface).count() == 6 + 2 * 12 + 8);
  CHECK(prepare::sharpen_bevels(model, {}, 2.4, {}) == 12);
  check_is_box(model.surface, {120, 60, 40});
}

TEST_CASE("bevels that are wide, that move too much or that are no hindrance stay", "[bevels]") {
  Model wide = bevelled_plate({120, 60, 20}, 6.5);
  const std::size_t faces = wide.surface.face_count();
  CHECK(prepare::sharpen_bevels(wide, {}, 20.0, {}) == 0);
  CHECK(wide.surface.face_count() == faces);
  Model far = bevelled_plate({120, 60, 10}, 3.0);
  CHECK(prepare::sharpen_bevels(far, {}, 1.0, {}) == 0);
  // Its ends are no shorter than folds can be.
  Model large = bevelled_plate({1200, 600, 100}, 25.0);
  CHECK(prepare::sharpen_bevels(large, {}, 24.0, {}) == 0);
}

TEST_CASE("a box with bevels is simplified to the box", "[bevels]") {
  Model model = chamfered({75, 40, 25}, 2.0);
  const prepare::SimplifyReport report = prepare::simplify(model, {}, {});
  CHECK(report.bevels_removed == 12);
  CHECK(report.deviation_mm < 2.5);
  check_is_box(model.surface, {150, 80, 50});
}

TEST_CASE("a rounded edge becomes a sharp one where it is small", "[bevels]") {
  // A quarter of a circle of 2.5 mm in eight faces, along one edge of a bar.
  std::vector<Vec2> outline{{0, 0}, {40, 0}};
  for (int i = 0; i <= 8; ++i) {
    const double t = i * 0.25 * 3.14159265358979323846 / 4.0;
    outline.push_back({37.5 + 2.5 * std::cos(t), 27.5 + 2.5 * std::sin(t)});
  }
  outline.push_back({0, 30});
  std::vector<Vec3> points;
  PolygonCorners polygons(2);
  const auto count = static_cast<std::uint32_t>(outline.size());
  for (const double z : {0.0, 150.0}) {
    for (const Vec2 p : outline) {
      points.push_back({p.x, p.y, z});
    }
  }
  for (std::uint32_t i = 0; i < count; ++i) {
    polygons[0].insert(polygons[0].begin(), i);
    polygons[1].push_back(count + i);
    polygons.push_back({i, (i + 1) % count, count + (i + 1) % count, count + i});
  }
  Model model = made_of_polygons(points, polygons);
  const prepare::SimplifyReport report = prepare::simplify(model, {}, {});
  CHECK(report.rulings_removed == 7);
  CHECK(report.bevels_removed == 1);
  check_is_box(model.surface, {40, 30, 150});
}
