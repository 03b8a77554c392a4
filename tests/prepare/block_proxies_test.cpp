// SPDX-License-Identifier: GPL-3.0-or-later
// Blocks in the place of busy bodies: which become some, and what they are like.
#include "prepare/bodies/block_proxies.hpp"

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "base/random.hpp"
#include "mesh/mesh.hpp"
#include "mesh/model/surface_distance.hpp"
#include "prepare/bodies/fit_prism.hpp"
#include "support/soups.hpp"

using namespace ridgecraft;
using test::box_faces;
using test::box_points;

namespace {

using CornerLists = std::vector<std::vector<std::uint32_t>>;

struct Scene {
  std::vector<Vec3> points;
  CornerLists faces;

  void add(const std::vector<Vec3>& other, const CornerLists& corners, Vec3 at) {
    for (const auto& face : test::shifted(corners, static_cast<std::uint32_t>(points.size()))) {
      faces.push_back(face);
    }
    for (const Vec3 p : other) {
      points.push_back(p + at);
    }
  }
  /// Turned about the z axis: sides around, by radius and height from below.
  void add_turned(std::uint32_t sides, const std::vector<Vec2>& profile, Vec3 at) {
    std::vector<Vec3> own;
    CornerLists corners(2);
    const auto rings = static_cast<std::uint32_t>(profile.size());
    for (std::uint32_t r = 0; r < rings; ++r) {
      for (std::uint32_t i = 0; i < sides; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / sides;
        own.push_back({profile[r].x * std::cos(angle), profile[r].x * std::sin(angle), profile[r].y});
        const std::uint32_t j = (i + 1) % sides;
        if (r + 1 < rings) {
          corners.push_back({r * sides + i, r * sides + j, (r + 1) * sides + j, (r + 1) * sides + i});
        }
      }
    }
    for (std::uint32_t i = 0; i < sides; ++i) {
      corners[0].push_back(sides - 1 - i);
      corners[1].push_back((rings - 1) * sides + i);
    }
    add(own, corners, at);
  }
  [[nodiscard]] mesh::Model model() const { return mesh::repair(test::soup(points, faces), {}, {}); }
};

const std::vector<Vec2> barrel{{5.0, 0.0}, {5.6, 4.0}, {6.0, 8.0}, {5.6, 12.0}, {5.0, 16.0}};
const std::vector<Vec2> bone{{6.0, 0.0}, {6.0, 3.0}, {2.0, 5.0}, {2.0, 15.0}, {6.0, 17.0}, {6.0, 20.0}};
const std::vector<Vec2> pointed{{6.0, 0.0}, {4.0, 4.0}, {2.0, 8.0}, {0.5, 12.0}};

/// A wall of 150 mm, and something before it.
Scene before_wall(std::uint32_t sides, const std::vector<Vec2>& profile) {
  Scene bodies;
  bodies.add(box_points({0, 0, 0}, {150, 10, 100}), box_faces, {});
  bodies.add_turned(sides, profile, {75, -20, 0});
  return bodies;
}

prepare::BlockProxies made_plain(mesh::Model& model) {
  return prepare::make_block_proxies(model, {6.0, 3.0, 6.0, 0.35, 0.05}, {});
}

std::vector<Vec3> random_turn(std::vector<Vec3> points, std::uint64_t seed) {
  Random random(seed);
  const auto direction = [&] { return Vec3{random.unit() - 0.5, random.unit() - 0.5, random.unit() - 0.5}; };
  const Vec3 x = normalized(direction());
  const Vec3 y = normalized(cross(x, direction()));
  const Vec3 z = cross(x, y);
  for (Vec3& p : points) {
    p = p.x * x + p.y * y + p.z * z;
  }
  return points;
}

}  // namespace

TEST_CASE("a barrel becomes a plain block, whichever way it lies", "[plain]") {
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    Scene bodies = before_wall(12, barrel);
    if (seed > 0) {
      bodies.points = random_turn(bodies.points, seed);
    }
    mesh::Model model = bodies.model();
    const mesh::Surface before = model.surface;
    const prepare::BlockProxies plain = made_plain(model);
    CHECK(plain.count == 1);
    CHECK(model.surface.component_count() == 2);
    // The wall's 12 triangles, and a prism of six sides.
    CHECK(model.surface.face_count() == 12 + 20);
    test::check_invariants(model.surface);
    CHECK(test::border_edges(model.surface) == 0);
    // It encloses the barrel, hardly larger than it is, and the way it moved is told.
    CHECK(test::volume(model.surface) > test::volume(before));
    CHECK(test::volume(model.surface) - 150000.0 < 1.6 * (test::volume(before) - 150000.0));
    const double moved = mesh::greatest_distance(mesh::SurfaceTree(before, 0.5),
                                                 mesh::SurfaceTree(model.surface, 0.5), INFINITY, {});
    CHECK(moved == Approx(plain.moved_mm).margin(0.3));
  }
}

TEST_CASE("what isn't like a block stays: a bone, a cone, a ball, a box, a body that is easy to fold",
          "[plain]") {
  std::vector<Vec2> ball;
  for (int i = 1; i < 12; ++i) {
    const double angle = std::numbers::pi * i / 12;
    ball.push_back({7.0 * std::sin(angle), 7.0 - 7.0 * std::cos(angle)});
  }
  for (const auto& profile : {bone, pointed, ball}) {
    mesh::Model model = before_wall(12, profile).model();
    CHECK(made_plain(model).count == 0);
  }
  // With six sides of 10 mm nothing is hard to fold.
  mesh::Model tower = before_wall(6, {{10.0, 0.0}, {10.0, 20.0}, {12.0, 30.0}}).model();
  CHECK(made_plain(tower).count == 0);
  Scene boxes;
  boxes.add(box_points({0, 0, 0}, {150, 10, 100}), box_faces, {});
  boxes.add(box_points({0, 0, 0}, {5, 5, 5}), box_faces, {50, -10, 0});
  mesh::Model plain = boxes.model();
  CHECK(made_plain(plain).count == 0);
  // What is long beside the model is what it is made of.
  Scene alone;
  alone.add_turned(12, barrel, {});
  alone.add_turned(12, barrel, {20, 0, 0});
  mesh::Model barrels = alone.model();
  CHECK(made_plain(barrels).count == 0);
}

TEST_CASE("a block has the materials of what it stands for", "[plain]") {
  mesh::Model model = before_wall(12, barrel).model();
  model.materials.resize(3);
  model.material = IdVector<FaceId, std::uint32_t>(model.surface.face_count(), 0U);
  for (const FaceId f : ids<FaceId>(model.surface.face_count())) {
    const bool of_barrel = model.surface.component(f) == model.surface.component(FaceId(12));
    model.material[f] = !of_barrel ? 0U : model.surface.normal(f).z > 0.9 ? 1U : 2U;
  }
  REQUIRE(made_plain(model).count == 1);
  std::size_t tops = 0;
  for (const FaceId f : ids<FaceId>(model.surface.face_count())) {
    const bool of_barrel = model.surface.component(f) == model.surface.component(FaceId(12));
    const bool top = of_barrel && model.surface.normal(f).z > 0.9;
    CHECK(model.material[f] == (!of_barrel ? 0U : top ? 1U : 2U));
    tops += top ? 1U : 0U;
  }
  CHECK(tops == 4);
}

TEST_CASE("a prism around points encloses them, and is a mirror image of itself where they are", "[plain]") {
  Random random(7);
  const auto along = [&] { return 20.0 * random.unit() - 10.0; };
  for (int round = 0; round < 30; ++round) {
    // Half of an outline, and its mirror image, at both ends.
    std::vector<Vec3> points;
    for (int i = 0; i < 12; ++i) {
      const Vec2 p{std::abs(along()), along()};
      for (const double z : {0.0, 8.0}) {
        points.push_back({p.x, p.y, z});
        points.push_back({-p.x, p.y, z});
      }
    }
    const auto prism = prepare::fit_prism(points, std::vector<Vec3>{{0, 0, 1}}, {4.5, 3.0});
    REQUIRE(prism);
    CHECK(prism->along.z == 8.0);
    const std::size_t sides = prism->base.size();
    CHECK(sides >= 3);
    double lopsided = 0.0;
    for (std::size_t i = 0; i < sides; ++i) {
      const Vec3 a = prism->base[i];
      const Vec3 side = prism->base[(i + 1) % sides] - a;
      for (const Vec3 p : points) {
        CHECK(cross(side, p - a).z >= -1e-3 * length(side));
      }
      double nearest = INFINITY;
      for (const Vec3 b : prism->base) {
        nearest = std::min(nearest, length(Vec3{-a.x, a.y, a.z} - b));
      }
      lopsided = std::max(lopsided, nearest);
    }
    CHECK(lopsided < 1e-6);
  }
}

TEST_CASE("a block doesn't depend on how its body lies, though its points are rounded", "[plain]") {
  // A straight tower, whose corners lie on each other seen from above, and a box with points along its edges.
  std::vector<Vec3> tower;
  for (int i = 0; i < 20; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / 20;
    for (const double z : {0.0, 5.0, 12.0}) {
      tower.push_back({6.0 * std::cos(angle), 6.0 * std::sin(angle), z});
    }
  }
  std::vector<Vec3> box;
  for (int i = 0; i <= 8; ++i) {
    for (const double z : {0.0, 9.0}) {
      for (const Vec2 p :
           {Vec2{i * 2.5, 0.0}, Vec2{i * 2.5, 14.0}, Vec2{0.0, i * 1.75}, Vec2{20.0, i * 1.75}}) {
        box.push_back({p.x, p.y, z});
      }
    }
  }
  for (const auto& upright : {tower, box}) {
    const auto first = prepare::fit_prism(upright, std::vector<Vec3>{{0, 0, 1}}, {4.5, 3.0});
    REQUIRE(first);
    for (std::uint64_t seed = 1; seed < 40; ++seed) {
      std::vector<Vec3> points = upright;
      points.push_back({0, 0, 1});
      points = random_turn(points, seed);
      const Vec3 along = normalized(points.back());
      points.pop_back();
      const auto turned = prepare::fit_prism(points, std::vector<Vec3>{along}, {4.5, 3.0});
      REQUIRE(turned);
      CHECK(turned->base.size() == first->base.size());
      CHECK(turned->volume() == Approx(first->volume()).epsilon(1e-6));
    }
  }
}

TEST_CASE("a silhouette counts holes as covered, and nothing else", "[plain]") {
  Scene small;
  small.add(box_points({0, 0, 0}, {5, 10, 2}), box_faces, {});
  const mesh::Surface half = small.model().surface;
  Scene large;
  large.add(box_points({0, 0, 0}, {10, 10, 2}), box_faces, {});
  const mesh::Surface whole = large.model().surface;
  CHECK(prepare::silhouette_fraction(half, whole, {0, 0, 1}) == Approx(0.5).margin(0.03));
  CHECK(prepare::silhouette_fraction(half, whole, {1, 0, 0}) == Approx(1.0).margin(0.03));
  // Four bars around a hole; then one of them is missing.
  Scene frame;
  frame.add(box_points({0, 0, 0}, {10, 2, 2}), box_faces, {});
  frame.add(box_points({0, 8, 0}, {10, 10, 2}), box_faces, {});
  frame.add(box_points({0, 2, 0}, {2, 8, 2}), box_faces, {});
  const mesh::Surface open = frame.model().surface;
  CHECK(prepare::silhouette_fraction(open, whole, {0, 0, 1}) == Approx(0.52).margin(0.03));
  frame.add(box_points({8, 2, 0}, {10, 8, 2}), box_faces, {});
  const mesh::Surface closed = frame.model().surface;
  CHECK(prepare::silhouette_fraction(closed, whole, {0, 0, 1}) == Approx(1.0).margin(0.03));
}
