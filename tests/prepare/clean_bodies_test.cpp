// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies before they are united: which are left out as nobody could hold them.
#include "prepare/clean_bodies.hpp"

#include <cmath>

#include "mesh/mesh.hpp"
#include "support/soups.hpp"

using namespace ridgecraft;
using mesh::Model;
using prepare::CleanupReport;
using test::both;
using test::box_faces;
using test::box_points;
using test::shifted;
using test::soup;

namespace {

struct Bodies {
  std::vector<Vec3> points;
  std::vector<std::vector<std::uint32_t>> faces;

  void add(const std::vector<Vec3>& other, const std::vector<std::vector<std::uint32_t>>& corners) {
    faces = both(faces, shifted(corners, static_cast<std::uint32_t>(points.size())));
    points = both(points, other);
  }
  void add_box(Vec3 low, Vec3 high) { add(box_points(low, high), box_faces); }
  /// Over a polygon that goes round to the left, seen from above.
  void add_prism(const std::vector<Vec3>& outline, double low, double high) {
    const auto n = static_cast<std::uint32_t>(outline.size());
    std::vector<Vec3> own;
    std::vector<std::vector<std::uint32_t>> sides(2);
    for (const double z : {low, high}) {
      for (const Vec3 p : outline) {
        own.push_back({p.x, p.y, z});
      }
    }
    for (std::uint32_t i = 0; i < n; ++i) {
      sides[0].push_back(n - 1 - i);
      sides[1].push_back(n + i);
      sides.push_back({i, (i + 1) % n, n + (i + 1) % n, n + i});
    }
    add(own, sides);
  }
  void add_sheet(Vec3 at, Vec3 u, Vec3 v) { add({at, at + u, at + u + v, at + v}, {{0, 1, 2, 3}}); }

  [[nodiscard]] Model model() const { return mesh::repair(soup(points, faces), {}, Context()); }
};

/// A wall of 150 mm with a post on top of it, as long as it is wide.
Bodies wall() {
  Bodies bodies;
  bodies.add_box({0, 0, 0}, {150, 100, 10});
  bodies.add_box({0, 100, 0}, {150, 102, 2});
  return bodies;
}

CleanupReport ready(Model& model, double size_mm, prepare::Simplification mode = {}) {
  prepare::SizeOptions size;
  size.largest_extent_mm = size_mm;
  prepare::SimplifyOptions simplify;
  simplify.mode = mode;
  simplify.faces = 10;
  return clean_bodies(model, size, simplify, Context());
}

}  // namespace

TEST_CASE("what nobody could hold is left out: bars, crumbs and panes on a wall") {
  Bodies bodies = wall();
  bodies.add_box({20, 20, 10}, {40, 22, 12});                // a bar
  bodies.add_box({60, 20, 10}, {61, 21, 11});                // a crumb
  bodies.add_box({20, 60, 10}, {40, 64, 12});                // a sill: 4 mm can be cut
  bodies.add_sheet({80, 20, 12.5}, {20, 0, 0}, {0, 15, 0});  // a pane on the wall
  bodies.add_sheet({110, 20, 14}, {20, 0, 0}, {0, 15, 0});   // one in the air before it
  bodies.add_sheet({10, 70, 12.5}, {60, 0, 0}, {0, 25, 0});  // a poster that is large
  // One before a hole: the wall has nothing behind its middle.
  bodies.add_sheet({150, 20, 10}, {5, 0, 0}, {0, 60, 0});
  bodies.add_sheet({175, 20, 10}, {5, 0, 0}, {0, 60, 0});
  bodies.add_sheet({155, 40, 10}, {20, 0, 0}, {0, 20, 0});
  Model model = bodies.model();
  const std::size_t before = model.surface.component_count();
  const CleanupReport report = ready(model, 150.0);
  CHECK(report.left_out.small == 2);
  CHECK(report.left_out.flat == 1);
  CHECK(model.surface.component_count() == before - 3);
  // The long post is as narrow as the bar and stays.
  CHECK(model.surface.bounds().high.y == 102.0);
}

TEST_CASE("a body that hardly stands out of a wall is left out, unless it is as plain as a box") {
  const auto framed = [](double thick, bool plain) {
    Bodies bodies = wall();
    const std::vector<Vec3> corners{{60, 40, 0}, {80, 40, 0}, {85, 50, 0},
                                    {80, 60, 0}, {60, 60, 0}, {55, 50, 0}};
    if (plain) {
      bodies.add_box({60, 40, 9}, {80, 60, 10 + thick});
    } else {
      bodies.add_prism(corners, 9, 10 + thick);
    }
    return bodies.model();
  };
  for (const double thick : {1.0, 2.5, 3.5}) {
    Model plate = framed(thick, false);
    CHECK(ready(plate, 150.0).left_out.low == (thick < 3.0 ? 1U : 0U));
    Model block = framed(thick, true);
    CHECK(ready(block, 150.0).left_out.count() == 0);
  }
  Model kept = framed(1.0, false);
  CHECK(ready(kept, 150.0, prepare::Simplification::keep).left_out.count() == 0);
}

TEST_CASE("what is too small depends on the size, not on the file's unit or on where the model stands") {
  for (const double unit : {1.0, 0.001, 40.0}) {
    for (const double turn : {0.0, 0.7}) {
      Bodies bodies = wall();
      bodies.add_box({20, 20, 10}, {40, 22, 12});
      for (Vec3& p : bodies.points) {
        p = unit * Vec3{std::cos(turn) * p.x - std::sin(turn) * p.y + 7.0,
                        std::sin(turn) * p.x + std::cos(turn) * p.y, p.z};
      }
      const double extent = bodies.model().surface.bounds().largest_extent();
      for (const auto& [scale, small] : {std::pair{1.0, 1U}, {1.6, 0U}}) {
        Model model = bodies.model();
        CHECK(ready(model, scale * extent / unit).left_out.small == small);
      }
    }
  }
}

TEST_CASE("a model that is made of small bodies keeps them") {
  Bodies bodies;
  for (int i = 0; i < 20; ++i) {
    bodies.add_box({8.0 * i, 0, 0}, {8.0 * i + 2, 20, 2});
  }
  Model model = bodies.model();
  CHECK(ready(model, 150.0).left_out.count() == 0);
  CHECK(model.surface.component_count() == 20);
}

TEST_CASE("who keeps all faces keeps all bodies") {
  Bodies bodies = wall();
  bodies.add_box({20, 20, 10}, {40, 22, 12});
  Model model = bodies.model();
  CHECK(ready(model, 150.0, prepare::Simplification::keep).left_out.count() == 0);
  CHECK(ready(model, 150.0, prepare::Simplification::count).left_out.count() == 1);
}

TEST_CASE("a model with too many faces loses details that would be hard to fold, if they are why") {
  const auto stones = [](int count) {
    Bodies bodies = wall();
    bodies.add_box({0, 0, -100}, {150, 100, -5});
    for (int i = 0; i < count; ++i) {
      const double x = 2.0 + 13.0 * (i % 10);
      const double y = 4.0 + 9.0 * (i / 10);
      bodies.add_box({x, y, 10}, {x + 3.5, y + 5, 13.5});  // 3.5 mm: can be folded, if need be
    }
    return bodies;
  };
  Model few = stones(20).model();
  CHECK(ready(few, 150.0).left_out.small == 0);
  Model many = stones(100).model();
  CHECK(ready(many, 150.0).left_out.small == 100);
  Bodies slices = stones(20);
  for (int i = 0; i < 100; ++i) {
    slices.add_box({0, 0, -200.0 - i}, {150, 100, -199.5 - i});
  }
  Model others = slices.model();
  CHECK(ready(others, 300.0).left_out.small == 0);
}

TEST_CASE("a pane in a hole stays, however small the hole, and one right before a wall goes") {
  // A wall of 150 x 100 with a slot of 5 x 30: four boxes around it.
  Bodies bodies;
  bodies.add_box({0, 0, 0}, {70, 100, 10});
  bodies.add_box({75, 0, 0}, {150, 100, 10});
  bodies.add_box({70, 0, 0}, {75, 30, 10});
  bodies.add_box({70, 60, 0}, {75, 100, 10});
  bodies.add_sheet({70, 30, 9.9}, {5, 0, 0}, {0, 30, 0});
  bodies.add_sheet({20, 40, 11}, {10, 0, 0}, {0, 10, 0});
  Model model = bodies.model();
  CHECK(ready(model, 150.0).left_out.flat == 1);
}

TEST_CASE("a square bar is as narrow however it is turned about itself") {
  for (const double turn : {0.0, 0.2, 0.5, 0.785}) {
    CAPTURE(turn);
    Bodies bodies = wall();
    std::vector<Vec3> bar = box_points({0, 0, 0}, {20, 2.7, 2.7});
    for (Vec3& p : bar) {
      p = Vec3{20.0 + p.x, 30.0 + std::cos(turn) * p.y - std::sin(turn) * p.z,
               14.0 + std::sin(turn) * p.y + std::cos(turn) * p.z};
    }
    bodies.add(bar, box_faces);
    Model model = bodies.model();
    CHECK(ready(model, 150.0).left_out.small == 1);
  }
}

TEST_CASE("what a detail held moves to what is near, or goes with it, unless it is large") {
  struct Case {
    double gap, extent;  // of the post that goes, of the body on it
    bool moves, goes;
  };
  for (const Case& c : {Case{8, 10, true, false}, Case{20, 10, false, true}, Case{20, 60, false, false}}) {
    Bodies bodies;
    bodies.add_box({0, 0, 0}, {150, 100, 10});
    bodies.add_box({50, 50, 10}, {52, 52, 10 + c.gap});
    bodies.add_box({50, 50, 10 + c.gap}, {50 + c.extent, 52 + c.extent, 10 + c.gap + c.extent});
    Model model = bodies.model();
    const CleanupReport report = ready(model, 150.0);
    CHECK(report.left_out.small == 1);
    CHECK(report.left_out.loose == (c.goes ? 1U : 0U));
    CHECK(model.surface.component_count() == (c.goes ? 1U : 2U));
    const double top = c.goes ? 10.0 : c.moves ? 10.0 + c.extent : 10.0 + c.gap + c.extent;
    CHECK(model.surface.bounds().high.z == Approx(top));
  }
}

TEST_CASE("what nothing held from the start stays where it is") {
  Bodies bodies = wall();
  bodies.add_box({60, 20, 10}, {61, 21, 11});  // a crumb, which goes
  bodies.add_box({20, 20, 30}, {30, 30, 40});
  Model model = bodies.model();
  const CleanupReport report = ready(model, 150.0);
  CHECK(report.left_out.small == 1);
  CHECK(report.left_out.loose == 0);
  CHECK(model.surface.bounds().high.z == 40.0);
}
