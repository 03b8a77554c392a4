// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies that touch or run into each other become one skin.
#include "prepare/skin/skin.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>

#include "base/random.hpp"
#include "prepare/bodies.hpp"
#include "support/soups.hpp"

using namespace ridgecraft;
using mesh::Model;
using test::both;
using test::box;
using test::box_faces;
using test::box_points;
using test::model_of_shape;
using test::Shape;
using test::shifted;
using test::soup;
using test::united;
using test::United;

namespace {

/// A regular prism of a random size, turned at random.
Shape random_prism(Random& random) {
  const std::uint32_t n = 3 + random.below(4);
  Shape shape;
  const double radius = 0.5 + random.unit();
  const double height = 0.5 + random.unit();
  for (const double z : {-height, height}) {
    for (std::uint32_t i = 0; i < n; ++i) {
      const double t = 2.0 * std::numbers::pi * i / n;
      shape.points.push_back({radius * std::cos(t), radius * std::sin(t), z});
    }
  }
  std::vector<std::uint32_t> top, bottom;
  for (std::uint32_t i = 0; i < n; ++i) {
    top.push_back(n + i);
    bottom.push_back(n - 1 - i);
    shape.faces.push_back({i, (i + 1) % n, n + (i + 1) % n, n + i});
  }
  shape.faces.push_back(top);
  shape.faces.push_back(bottom);
  const double a = 7.0 * random.unit();
  const double b = 7.0 * random.unit();
  const Vec3 shift{random.unit(), random.unit(), random.unit()};
  for (Vec3& p : shape.points) {
    p = {p.x * std::cos(a) - p.y * std::sin(a), p.x * std::sin(a) + p.y * std::cos(a), p.z};
    p = Vec3{p.x, p.y * std::cos(b) - p.z * std::sin(b), p.y * std::sin(b) + p.z * std::cos(b)} + shift;
  }
  return shape;
}

/// Is a point inside a convex shape?
bool inside(const Shape& shape, Vec3 p) {
  return std::all_of(shape.faces.begin(), shape.faces.end(), [&](const auto& face) {
    const Vec3 a = shape.points[face[0]];
    return dot(cross(shape.points[face[1]] - a, shape.points[face[2]] - a), p - a) <= 0.0;
  });
}

/// Area of the part of a convex shape's surface that isn't inside any of the others: by points spread over
/// it.
double visible_area(const Shape& shape, const std::vector<Shape>& others) {
  constexpr int steps = 60;
  double area = 0.0;
  for (const auto& face : shape.faces) {
    for (std::size_t k = 2; k < face.size(); ++k) {
      const Vec3 a = shape.points[face[0]];
      const Vec3 u = shape.points[face[k - 1]] - a;
      const Vec3 v = shape.points[face[k]] - a;
      int seen = 0;
      int all = 0;
      for (int i = 0; i < steps; ++i) {
        for (int j = 0; i + j < steps; ++j) {
          const Vec3 p = a + (i + 1.0 / 3) / steps * u + (j + 1.0 / 3) / steps * v;
          ++all;
          seen += std::none_of(others.begin(), others.end(), [&](const Shape& s) { return inside(s, p); });
        }
      }
      area += 0.5 * length(cross(u, v)) * seen / all;
    }
  }
  return area;
}

/// Does a ray from outside meet anything of a soup of triangles, and where first?
std::optional<double> first_hit(const mesh::Surface& surface, Vec3 from, Vec3 way) {
  std::optional<double> nearest;
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    const auto [i, j, k] = surface.vertices(f);
    const Vec3 a = surface.point(i);
    const Vec3 u = surface.point(j) - a;
    const Vec3 v = surface.point(k) - a;
    const Vec3 p = cross(way, v);
    const double det = dot(u, p);
    if (std::abs(det) < 1e-14) {
      continue;
    }
    const Vec3 s = from - a;
    const double x = dot(s, p) / det;
    const Vec3 q = cross(s, u);
    const double y = dot(way, q) / det;
    const double t = dot(v, q) / det;
    if (x >= 0 && y >= 0 && x + y <= 1 && t > 0 && (!nearest || t < *nearest)) {
      nearest = t;
    }
  }
  return nearest;
}

}  // namespace

TEST_CASE("bodies that touch in a face, a part of one, an edge or a corner", "[skin]") {
  Shape shape = box({0, 0, 0}, {2, 2, 2});
  SECTION("a whole face") {
    shape.add(box({2, 0, 0}, {3, 2, 2}));
    // Equal corners are joined in reading; then nothing is left to be united.
    const United one = united(shape);
    CHECK(one.model.surface.component_count() == 1);
    CHECK(test::volume(one.model.surface) == Approx(12.0));
    CHECK(test::area(one.model.surface) == Approx(2 * (3 * 2 + 3 * 2 + 2 * 2)));
  }
  SECTION("a part of a face") {
    shape.add(box({2, 0.5, 0.25}, {3, 1.5, 1.75}));
    const United one = united(shape);
    CHECK(one.report.united == 2);
    CHECK(one.report.united_into == 1);
    CHECK(one.model.surface.component_count() == 1);
    CHECK(test::border_edges(one.model.surface) == 0);
    CHECK(test::volume(one.model.surface) == Approx(8 + 1.5));
    CHECK(test::area(one.model.surface) == Approx(24 + 2 * (1 + 1.5)));
  }
  SECTION("a face that both stick out of") {
    shape.add(box({2, 1, 1}, {3, 3, 3}));
    const United one = united(shape);
    CHECK(one.model.surface.component_count() == 1);
    CHECK(test::volume(one.model.surface) == Approx(12.0));
    CHECK(test::area(one.model.surface) == Approx(24 + 16 - 2.0));
  }
  SECTION("an edge, a corner, nothing") {
    const Vec3 at = GENERATE(Vec3{2, 2, 0.5}, Vec3{2, 2, 2}, Vec3{2, 2, 3});
    shape.add(box(at, at + Vec3{1, 1, 1}));
    const Model before = model_of_shape(shape);
    const United two = united(shape);
    CHECK(two.report.united == 0);
    CHECK(std::equal(two.model.surface.points().begin(), two.model.surface.points().end(),
                     before.surface.points().begin(), before.surface.points().end()));
    CHECK(two.model.polygon == before.polygon);
  }
  SECTION("flush: two faces in one plane") {
    shape.add(box({1, 0, 0}, {3, 2, 2}));
    const United one = united(shape);
    CHECK(one.model.surface.component_count() == 1);
    CHECK(test::volume(one.model.surface) == Approx(12.0));
    CHECK(test::area(one.model.surface) == Approx(2 * (6 + 6 + 4)));
  }
  SECTION("one in the other") {
    shape.add(box({0.5, 0.5, 0.5}, {1, 1, 1}));
    const United one = united(shape);
    CHECK(one.report.faces_hidden == 12);
    CHECK(one.report.united == 2);
    CHECK(one.report.united_into == 1);
    CHECK(one.report.hidden_fraction == Approx(1.5 / 25.5));
    CHECK(test::volume(one.model.surface) == Approx(8.0));
    CHECK(one.model.surface.face_count() == 12);
  }
  SECTION("the same twice, apart in the file") {
    Shape moved = box({0, 0, 0}, {2, 2, 2});
    for (Vec3& p : moved.points) {
      p.x += 1e-7;  // within the grid, beyond what is joined
    }
    shape.add(moved);
    CHECK(test::volume(united(shape).model.surface) == Approx(8.0).epsilon(1e-5));
  }
}

TEST_CASE("a heap of cubes with a way through it", "[skin]") {
  // Slightly too large cubes, so that all run into each other; the middle row is missing.
  Shape shape;
  for (int i = 0; i < 27; ++i) {
    const Vec3 at{double(i % 3), double(i / 3 % 3), double(i / 9)};
    if (at.x != 1 || at.y != 1) {
      shape.add(box(at, at + Vec3{1.125, 1.125, 1.125}));
    }
  }
  const United heap = united(shape);
  CHECK(heap.report.united == 24);
  CHECK(heap.model.surface.component_count() == 1);
  CHECK(test::euler(heap.model.surface) == 0);
  const double side = 3.125;
  const double hole = 0.875;
  CHECK(test::volume(heap.model.surface) == Approx(side * side * side - hole * hole * side));
}

namespace {

/// Cells of a grid, with an empty one all around.
class Cells {
 public:
  static constexpr int size = 8;

  bool& at(int x, int y, int z) { return full_[static_cast<std::size_t>((x * size + y) * size + z)]; }

  /// How many are full, or can't be reached from outside over the sides of cells; by `corners` over their
  /// edges and corners, too.
  int closed(bool corners) {
    std::set<std::array<int, 3>> reached{{0, 0, 0}};
    std::vector<std::array<int, 3>> open{{0, 0, 0}};
    while (!open.empty()) {
      const auto [x, y, z] = open.back();
      open.pop_back();
      for (int i = 0; i < 27; ++i) {
        const std::array<int, 3> d{i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1};
        const std::array<int, 3> next{x + d[0], y + d[1], z + d[2]};
        const bool in = std::all_of(next.begin(), next.end(), [](int k) { return k >= 0 && k < size; });
        if (in && (corners || std::abs(d[0]) + std::abs(d[1]) + std::abs(d[2]) == 1) &&
            !at(next[0], next[1], next[2]) && reached.insert(next).second) {
          open.push_back(next);
        }
      }
    }
    return size * size * size - static_cast<int>(reached.size());
  }

 private:
  std::array<bool, size * size * size> full_{};
};

}  // namespace

TEST_CASE("boxes on a grid: the volume is counted in cells", "[skin]") {
  // All kinds of contact at once: faces, parts of them, edges, corners, planes in common; straight and
  // turned.
  Random random(12);
  int counted = 0;
  for (int round = 0; round < 120; ++round) {
    INFO("round " << round);
    Shape shape;
    Cells cells;
    const bool turned = round % 2 == 1;
    const std::uint32_t count = 2 + random.below(5);
    for (std::uint32_t i = 0; i < count; ++i) {
      std::array<int, 3> low{}, high{};
      for (std::size_t k = 0; k < 3; ++k) {
        low[k] = 1 + static_cast<int>(random.below(4));
        high[k] = low[k] + 1 + static_cast<int>(random.below(3));
      }
      Shape next = box({double(low[0]), double(low[1]), double(low[2])},
                       {double(high[0]), double(high[1]), double(high[2])});
      for (Vec3& p : next.points) {
        p = turned ? Vec3{0.8 * p.x - 0.6 * p.y, 0.6 * p.x + 0.8 * p.y, p.z} : p;
      }
      shape.add(next);
      for (int x = low[0]; x < high[0]; ++x) {
        for (int y = low[1]; y < high[1]; ++y) {
          for (int z = low[2]; z < high[2]; ++z) {
            cells.at(x, y, z) = true;
          }
        }
      }
    }
    // Two boxes with one face lose a copy of it in reading; cavities that touch the outside are no matter
    // here.
    if (model_of_shape(shape).repairs.count(mesh::RepairKind::duplicate_faces_dropped) > 0 ||
        cells.closed(false) != cells.closed(true)) {
      continue;
    }
    ++counted;
    const United one = united(shape);
    CHECK(one.report.left_crossing == 0);
    CHECK(test::border_edges(one.model.surface) == 0);
    CHECK(test::volume(one.model.surface) == Approx(cells.closed(false)).epsilon(1e-5));
  }
  CHECK(counted > 60);
}

TEST_CASE("random bodies: area of what can be seen, by points spread over it", "[skin]") {
  Random random(77);
  for (int round = 0; round < 25; ++round) {
    INFO("round " << round);
    std::vector<Shape> bodies;
    Shape all;
    const std::uint32_t count = 2 + random.below(3);
    for (std::uint32_t i = 0; i < count; ++i) {
      bodies.push_back(random_prism(random));
      all.add(bodies.back());
    }
    const United one = united(all);
    CHECK(one.report.left_crossing == 0);
    CHECK(test::border_edges(one.model.surface) == 0);
    double area = 0.0;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      std::vector<Shape> others = bodies;
      others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
      area += visible_area(bodies[i], others);
    }
    CHECK(test::area(one.model.surface) == Approx(area).epsilon(0.01));
    // What is seen from outside is the same as before, from everywhere.
    const Model before = model_of_shape(all);
    for (int k = 0; k < 40; ++k) {
      const Vec3 from{8 * random.unit() - 4, 8 * random.unit() - 4, 9.0};
      const Vec3 to{3 * random.unit() - 1, 3 * random.unit() - 1, 3 * random.unit() - 1};
      const auto was = first_hit(before.surface, from, to - from);
      const auto is = first_hit(one.model.surface, from, to - from);
      REQUIRE(was.has_value() == is.has_value());
      if (was) {
        CHECK(*is == Approx(*was).epsilon(1e-4));
      }
    }
    // Each face shows the polygon that it is a part of.
    for (const FaceId f : ids<FaceId>(one.model.surface.face_count())) {
      const auto& polygon = all.faces.at(one.model.polygon[f]);
      const Vec3 a = all.points[polygon[0]];
      const Vec3 n = normalized(cross(all.points[polygon[1]] - a, all.points[polygon[2]] - a));
      for (const VertexId v : one.model.surface.vertices(f)) {
        REQUIRE(std::abs(dot(n, one.model.surface.point(v) - a)) < 1e-5);
      }
    }
    // Neither the order of the bodies nor where they lie makes a difference.
    Shape other;
    for (std::size_t i = bodies.size(); i-- > 0;) {
      Shape turned = bodies[i];
      for (Vec3& p : turned.points) {
        p = {p.y + 3.0, p.z, p.x};
      }
      other.add(turned);
    }
    CHECK(test::volume(united(other).model.surface) == Approx(test::volume(one.model.surface)).epsilon(1e-5));
  }
}

TEST_CASE("materials stay where they were", "[skin]") {
  Shape shape = box({0, 0, 0}, {2, 2, 2});
  shape.add(box({1, 0.5, 0.5}, {3, 1.5, 1.5}));
  mesh::Soup s = soup(shape.points, shape.faces);
  s.materials = {{"red", {}, {}}, {"blue", {}, {}}};
  for (std::size_t i = 0; i < 12; ++i) {
    s.polygon_material.push_back(i < 6 ? 0 : 1);
  }
  Model model = test::repaired(s);
  prepare::unite_bodies(model, {});
  REQUIRE(model.material.size() == model.surface.face_count());
  for (const FaceId f : ids<FaceId>(model.surface.face_count())) {
    CHECK(model.material[f] == (model.polygon[f] < 6 ? 0 : 1));
  }
}

TEST_CASE("faces of one skin know what they were called") {
  mesh::Soup named = soup(both(box_points({0, 0, 0}, {4, 4, 4}), box_points({1, 1, 2}, {3, 3, 9})),
                          both(box_faces, shifted(box_faces, 8)));
  named.objects = {{0, "house"}, {6, "chimney"}};
  Model model = mesh::repair(std::move(named), {}, Context());
  REQUIRE(prepare::unite_bodies(model, Context()).united_into == 1);
  std::set<std::string> names;
  for (const FaceId f : ids<FaceId>(model.surface.face_count())) {
    const auto [a, b, c] = model.surface.vertices(f);
    const double top =
        std::max({model.surface.point(a).z, model.surface.point(b).z, model.surface.point(c).z});
    CHECK(model.object_name(f) == (top > 4.0 ? "chimney" : "house"));
    names.insert(model.object_name(f));
  }
  CHECK(names.size() == 2);
}

TEST_CASE("a rail that ends just before a leg touches it", "[skin]") {
  for (const double lean : {0.0, 0.1}) {
    for (const double gap : {0.004, -0.1, 0.02}) {
      INFO("gap " << gap << ", leaning by " << lean);
      Shape shape = box({0, 0, 0}, {1, 1, 10});
      for (Vec3& p : shape.points) {
        p.x += lean * (p.z - 4.25);
      }
      Shape rail = box({1, 0.3, 4}, {4, 0.7, 4.5});
      for (Vec3& p : rail.points) {
        p.x += p.x < 2.0 ? lean * (p.z - 4.25) + gap : 0.0;
      }
      shape.add(rail);
      const Model before = model_of_shape(shape);
      const United one = united(shape);
      if (gap == 0.02) {
        CHECK(one.report.united == 0);
        CHECK(one.model.surface.component_count() == 2);
        CHECK(std::equal(before.surface.points().begin(), before.surface.points().end(),
                         one.model.surface.points().begin()));
        continue;
      }
      CHECK(one.report.united == 2);
      CHECK(one.report.gaps_closed == (gap == 0.004 ? 4 : 0));
      CHECK(one.model.surface.component_count() == 1);
      // Nothing but the gap has changed: no plane is tilted.
      for (const FaceId f : ids<FaceId>(one.model.surface.face_count())) {
        const Vec3 normal = one.model.surface.normal(f);
        CHECK(std::any_of(shape.faces.begin(), shape.faces.end(), [&](const auto& face) {
          const Vec3 a = shape.points[face[0]];
          return dot(normal, normalized(cross(shape.points[face[1]] - a, shape.points[face[2]] - a))) >
                 1.0 - 1e-4;
        }));
      }
    }
  }
}
