// SPDX-License-Identifier: GPL-3.0-or-later
// Hard surfaces keep their planes when they are simplified.
#include "prepare/walls/walls.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <tuple>

#include "mesh/mesh.hpp"
#include "prepare/common_models.hpp"
#include "prepare/domains/domain.hpp"
#include "prepare/domains/find_domain.hpp"
#include "prepare/features/trim_reliefs.hpp"
#include "prepare/panels/remesh_panels.hpp"
#include "prepare/prepare.hpp"
#include "support/shapes.hpp"
#include "support/soups.hpp"

using namespace ridgecraft;
using prepare::Prepared;
using prepare::SimplifyOptions;
using test::page;

namespace {

/// Polygons of which each has its own points; repair joins them.
struct Polygons {
  mesh::Soup soup;

  void add(const std::vector<Vec3>& corners) {
    for (const Vec3 p : corners) {
      soup.corner_point.push_back(static_cast<std::uint32_t>(soup.points.size()));
      soup.points.push_back(p);
    }
    soup.first_corner.push_back(static_cast<std::uint32_t>(soup.corner_point.size()));
  }
};

/// A box around the origin, its edges cut off by planes at 45 degrees.
mesh::Soup bevelled_box(Vec3 size, double bevel) {
  Polygons polygons;
  const std::array<double, 3> half{size.x / 2, size.y / 2, size.z / 2};
  // The corner of octant `sign` that lies in the face across axis k.
  const auto corner = [&](std::array<int, 3> sign, std::size_t k) {
    std::array<double, 3> p{};
    for (std::size_t i = 0; i < 3; ++i) {
      p[i] = sign[i] * (half[i] - (i == k ? 0.0 : bevel));
    }
    return Vec3{p[0], p[1], p[2]};
  };
  const auto add_outwards = [&](std::vector<Vec3> corners) {
    Vec3 middle;
    for (const Vec3 p : corners) {
      middle += p;
    }
    if (dot(cross(corners[1] - corners[0], corners[2] - corners[0]), middle) < 0.0) {
      std::reverse(corners.begin(), corners.end());
    }
    polygons.add(corners);
  };
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t i = (k + 1) % 3;
    const std::size_t j = (k + 2) % 3;
    for (const int side : {-1, 1}) {
      const auto at = [&](int a, int b, std::size_t face) {
        std::array<int, 3> sign{};
        sign[k] = side;
        sign[i] = a;
        sign[j] = b;
        return corner(sign, face);
      };
      add_outwards({at(-1, -1, k), at(1, -1, k), at(1, 1, k), at(-1, 1, k)});
      for (const int a : {-1, 1}) {
        add_outwards({at(a, -1, k), at(a, 1, k), at(a, 1, i), at(a, -1, i)});
      }
    }
  }
  for (const int x : {-1, 1}) {
    for (const int y : {-1, 1}) {
      for (const int z : {-1, 1}) {
        add_outwards({corner({x, y, z}, 0), corner({x, y, z}, 1), corner({x, y, z}, 2)});
      }
    }
  }
  return polygons.soup;
}

/// A regular polygon of `sides` corners, upright, from z = 0 to `height`.
mesh::Soup prism(int sides, double radius, double height) {
  Polygons polygons;
  const auto at = [&](int i, double z) {
    const double angle = 2.0 * std::numbers::pi * i / sides;
    return Vec3{radius * std::cos(angle), radius * std::sin(angle), z};
  };
  std::vector<Vec3> top;
  std::vector<Vec3> bottom;
  for (int i = 0; i < sides; ++i) {
    polygons.add({at(i, 0), at(i + 1, 0), at(i + 1, height), at(i, height)});
    top.push_back(at(i, height));
    bottom.push_back(at(sides - i, 0));
  }
  polygons.add(top);
  polygons.add(bottom);
  return polygons.soup;
}

void append(mesh::Soup& soup, const mesh::Soup& other, Vec3 by) {
  const auto first = static_cast<std::uint32_t>(soup.points.size());
  const auto corners = static_cast<std::uint32_t>(soup.corner_point.size());
  for (const Vec3 p : other.points) {
    soup.points.push_back(p + by);
  }
  for (const std::uint32_t c : other.corner_point) {
    soup.corner_point.push_back(first + c);
  }
  for (const std::uint32_t c : other.first_corner) {
    if (c > 0) {
      soup.first_corner.push_back(corners + c);
    }
  }
}

/// At the size of its numbers in mm.
Prepared prepared(const mesh::Soup& soup, const SimplifyOptions& options = {}) {
  prepare::SizeOptions size;
  size.mm_per_unit = 1.0;
  return prepare::prepare(test::repaired(soup), size, options, page, {});
}

/// Share of the area across the axes.
double axis_fraction(const mesh::Surface& surface) {
  double along = 0.0;
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    const Vec3 n = surface.normal(f);
    along += std::max({std::abs(n.x), std::abs(n.y), std::abs(n.z)}) > 0.99985 ? surface.area(f) : 0.0;
  }
  return along / mesh::total_area(surface);
}

}  // namespace

TEST_CASE("bevels go, and the walls beside them meet at right angles", "[walls]") {
  const Prepared p = prepared(bevelled_box({120, 80, 50}, 1.5));
  CHECK(p.simplified.faces_before == 44);
  CHECK(p.simplified.faces_after == 12);
  CHECK(axis_fraction(p.model.surface) == Approx(1.0));
  const Vec3 size = p.model.surface.bounds().size();
  CHECK(size.x == Approx(120.0).margin(1e-6));
  CHECK(size.y == Approx(80.0).margin(1e-6));
  CHECK(size.z == Approx(50.0).margin(1e-6));
  CHECK(p.work.short_edges == 0.0);
  // A corner moves from the middle of three bevels to where the walls meet.
  CHECK(p.simplified.deviation_mm == Approx(1.5 * 2.0 / std::sqrt(3.0)).margin(0.01));
}

TEST_CASE("something round keeps its caps flat and its size", "[walls]") {
  const Prepared p = prepared(prism(120, 40.0, 60.0));
  CHECK(p.simplified.faces_after < p.simplified.faces_before / 2);
  double caps = 0.0;
  for (const FaceId f : ids<FaceId>(p.model.surface.face_count())) {
    const Vec3 n = p.model.surface.normal(f);
    caps += std::abs(n.z) > 0.999999 ? p.model.surface.area(f) : 0.0;
  }
  CHECK(caps > 0.97 * 2.0 * std::numbers::pi * 1600.0);
  CHECK(p.model.surface.bounds().size().z == Approx(60.0).margin(1e-6));
}

TEST_CASE("a component that can be folded isn't touched by what others need", "[walls]") {
  mesh::Soup soup = test::soup_of(test::scaled(test::sphere(90, 45), 25.0));
  append(soup, bevelled_box({60, 60, 60}, 10.0), {80, 0, 0});
  const Prepared p = prepared(soup);
  REQUIRE(p.simplified.faces_after < p.simplified.faces_before / 2);
  // Its points are where they were (the whole is centred anew).
  const mesh::Surface& surface = p.model.surface;
  std::size_t of_box = 0;
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    const auto [a, b, c] = surface.vertices(f);
    of_box += surface.point(a).x > 0.0 && surface.point(b).x > 0.0 && surface.point(c).x > 0.0 ? 1U : 0U;
  }
  CHECK(of_box == 44);
}

TEST_CASE("a smooth model gets few faces, and the deviation told is true", "[walls][slow]") {
  const Prepared p = prepared(test::soup_of(test::scaled(test::sphere(200, 100), 75.0)));
  CHECK(p.simplified.faces_before > 30000);
  CHECK(p.simplified.faces_after <= 1000);
  CHECK(p.simplified.faces_after >= 200);
  CHECK(p.simplified.deviation_mm < 3.0);
  // An exact sphere says how far points of the faces are off.
  const mesh::Surface& surface = p.model.surface;
  double farthest = 0.0;
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    const auto [a, b, c] = surface.vertices(f);
    for (const double t : {0.0, 0.25, 0.5}) {
      for (const double u : {0.0, 0.25, 0.5}) {
        const Vec3 point = surface.point(a) + t * (surface.point(b) - surface.point(a)) +
                           u * (surface.point(c) - surface.point(a));
        farthest = std::max(farthest, std::abs(length(point) - 75.0));
      }
    }
  }
  CHECK(farthest <= 1.05 * p.simplified.deviation_mm + 0.05);
  CHECK(farthest >= 0.7 * p.simplified.deviation_mm);
}

TEST_CASE("a number of faces counts more than walls", "[walls]") {
  // A staircase: all its regions are walls.
  std::vector<std::array<int, 3>> cells;
  for (int x = 0; x < 12; ++x) {
    for (int z = 0; z <= x; ++z) {
      cells.push_back({x, 0, z});
    }
  }
  SimplifyOptions options;
  options.mode = prepare::Simplification::count;
  options.faces = 30;
  const Prepared p = prepared(test::soup_of(test::scaled(test::voxels(cells), 12.0)), options);
  CHECK(p.simplified.faces_before > 90);
  CHECK(p.simplified.faces_after <= 30);
}

TEST_CASE("small holes through walls are closed", "[walls]") {
  // A plate of 9 x 9 cells of 5 mm with one missing in the middle.
  std::vector<std::array<int, 3>> cells;
  for (int x = 0; x < 9; ++x) {
    for (int y = 0; y < 9; ++y) {
      if (x != 4 || y != 4) {
        cells.push_back({x, y, 0});
      }
    }
  }
  mesh::Model model = test::repaired(test::soup_of(test::scaled(test::voxels(cells), 5.0)));
  prepare::remesh_panels(model, {});
  REQUIRE(test::euler(model.surface) == 0);
  mesh::Model closed = model;
  CHECK(prepare::trim_reliefs(closed, {}, 3.0, {}) == 1);
  CHECK(test::euler(closed.surface) == 2);
  CHECK(closed.surface.face_count() == 12);
  test::check_invariants(closed.surface);
  // Deeper than the surface may move, or wider than a short edge, it stays.
  mesh::Model deep = model;
  CHECK(prepare::trim_reliefs(deep, {}, 2.0, {}) == 0);
  SimplifyOptions narrow;
  narrow.short_edge_mm = 4.0;
  CHECK(prepare::trim_reliefs(deep, narrow, 3.0, {}) == 0);
  CHECK(deep.surface.face_count() == model.surface.face_count());
}

TEST_CASE("a wall that grooves run across is one, however narrow what they leave of it", "[walls]") {
  // Strips of 4.5 x 30 mm, which are no walls by themselves, with grooves of 22 degrees between them; each
  // strip is higher than the one before by `step`.
  const auto strips_that_are_walls = [](double step) {
    constexpr int strips = 8;
    std::vector<Vec2> outline{{6.0 * strips, -10.0}, {6.0 * strips, step * (strips - 1)}};
    for (int i = strips - 1; i >= 0; --i) {
      outline.push_back({6.0 * i + 5.25, step * i - 0.3});
      outline.push_back({6.0 * i + 4.5, step * i});
      outline.push_back({6.0 * i, step * i});
    }
    outline.push_back({0.0, -10.0});
    Polygons polygons;
    std::vector<Vec3> front;
    std::vector<Vec3> back;
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const Vec2 a = outline[i];
      const Vec2 b = outline[(i + 1) % outline.size()];
      polygons.add({{a.x, 0, a.y}, {a.x, 30, a.y}, {b.x, 30, b.y}, {b.x, 0, b.y}});
      front.push_back({a.x, 0, a.y});
      back.insert(back.begin(), Vec3{a.x, 30, a.y});
    }
    polygons.add(front);
    polygons.add(back);
    mesh::Model model = test::repaired(polygons.soup);
    prepare::remesh_panels(model, {});
    const mesh::Surface& surface = model.surface;
    const prepare::Walls walls = prepare::find_walls(surface, prepare::find_panels(surface), 6.0);
    std::size_t count = 0;
    for (const FaceId f : ids<FaceId>(surface.face_count())) {
      count += surface.normal(f).z > 0.999 && walls.wall(f.value()) != prepare::Walls::none ? 1U : 0U;
    }
    return count / 2;  // of two triangles each
  };
  CHECK(strips_that_are_walls(0.0) == 8);
  // The first one ends at edges for the most part.
  CHECK(strips_that_are_walls(0.2) == 1);
}

TEST_CASE("a share that is divided by components and joined again is the same model", "[walls]") {
  mesh::Soup soup = bevelled_box({20, 20, 20}, 3.0);
  append(soup, bevelled_box({20, 20, 20}, 3.0), {50, 0, 0});
  append(soup, prism(12, 8.0, 30.0), {25, 40, 0});
  const mesh::Model model = test::repaired(soup);
  const prepare::FundamentalDomain domain = prepare::fundamental_domain(model, 0.004, {});
  const mesh::LooseFaces all = mesh::take_apart(model);
  const mesh::LooseFaces once = prepare::expand(domain, all);
  const mesh::LooseFaces again = prepare::expand(prepare::joined(prepare::divided(domain)), all);
  REQUIRE(once.faces.size() == again.faces.size());
  const auto sorted_corners = [](const mesh::LooseFaces& faces) {
    std::vector<std::array<double, 9>> result;
    for (const auto& [a, b, c] : faces.faces) {
      std::array<Vec3, 3> corners{faces.points[a], faces.points[b], faces.points[c]};
      std::sort(corners.begin(), corners.end(),
                [](Vec3 p, Vec3 q) { return std::tie(p.x, p.y, p.z) < std::tie(q.x, q.y, q.z); });
      result.push_back({corners[0].x, corners[0].y, corners[0].z, corners[1].x, corners[1].y, corners[1].z,
                        corners[2].x, corners[2].y, corners[2].z});
    }
    std::sort(result.begin(), result.end());
    return result;
  };
  CHECK(sorted_corners(once) == sorted_corners(again));
}

TEST_CASE("a model gets the size at which it can be folded", "[size]") {
  prepare::SizeOptions size;
  size.adapts = true;
  // A bundle of long rods with 3 mm wide sides at 150 mm: nothing helps but size.
  mesh::Soup rods;
  for (int i = 0; i < 5; ++i) {
    append(rods, prism(3, 1.7, 150.0), {0.0, 6.0 * i, 0.0});
  }
  const Prepared larger = prepare::prepare(test::repaired(rods), size, {}, page, {});
  CHECK(larger.size_reason == prepare::SizeReason::folds);
  CHECK(prepare::can_be_folded(larger));
  CHECK(larger.model.surface.bounds().largest_extent() > 200.0);
  CHECK(larger.model.surface.bounds().largest_extent() <= 400.0);
  // Who asks for a size gets it, and is told which one would do.
  size.adapts = false;
  size.largest_extent_mm = 30.0;
  const Prepared asked = prepare::prepare(test::repaired(rods), size, {}, page, {});
  CHECK(asked.model.surface.bounds().largest_extent() == Approx(30.0));
  CHECK_FALSE(prepare::can_be_folded(asked));
  REQUIRE(asked.smallest_size_mm);
  size.largest_extent_mm = *asked.smallest_size_mm;
  CHECK(prepare::can_be_folded(prepare::prepare(test::repaired(rods), size, {}, page, {})));
  // What can be folded stays as large as it always was ...
  size = {};
  size.adapts = true;
  const Prepared usual = prepare::prepare(test::repaired(test::soup_of(test::cube())), size, {}, page, {});
  CHECK(usual.size_reason == prepare::SizeReason::none);
  CHECK(usual.model.surface.bounds().largest_extent() == Approx(150.0));
  // ... unless it takes too much paper.
  mesh::Soup cubes;
  for (int i = 0; i < 8; ++i) {
    append(cubes, test::soup_of(test::cube()), {1.5 * (i % 2), 1.5 * ((i / 2) % 2), 1.5 * (i / 4)});
  }
  size.most_pages = 3.0;
  const Prepared smaller = prepare::prepare(test::repaired(cubes), size, {}, page, {});
  CHECK(smaller.size_reason == prepare::SizeReason::pages);
  CHECK(smaller.model.surface.bounds().largest_extent() < 150.0);
}

TEST_CASE("a model with too many short edges gets a larger size", "[size]") {
  // Two tiles whose edges are shorter than 5 mm at 150 mm; everything is as its maker made it.
  mesh::Soup tiles = prism(6, 8.0, 4.4);
  append(tiles, prism(6, 8.0, 4.4), {134.0, 0.0, 0.0});
  prepare::SizeOptions size;
  size.adapts = true;
  const Prepared larger = prepare::prepare(test::repaired(tiles), size, {}, page, {});
  CHECK(larger.size_reason == prepare::SizeReason::folds);
  CHECK(larger.model.surface.bounds().largest_extent() == Approx(190.0));
  CHECK(larger.work.short_edges == 0.0);
  // Not beyond the limits, though: neither that of the size ...
  size.largest_mm = 180.0;
  const Prepared usual = prepare::prepare(test::repaired(tiles), size, {}, page, {});
  CHECK(usual.size_reason == prepare::SizeReason::none);
  CHECK(usual.model.surface.bounds().largest_extent() == Approx(150.0));
  CHECK(usual.work.short_share() > 0.1);
  // ... nor that of the pages.
  size.largest_mm = 400.0;
  size.smallest_mm = 150.0;
  size.most_pages = 0.03;
  CHECK(prepare::prepare(test::repaired(tiles), size, {}, page, {}).size_reason == prepare::SizeReason::none);
}
