// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/search/net_search.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <numbers>

#include <catch2/catch.hpp>

#include "base/geometry.hpp"
#include "base/random.hpp"
#include "bench/spiky_bodies.hpp"
#include "support/shapes.hpp"
#include "unfold/nets_checks.hpp"
#include "unfold/patch/layout.hpp"

using namespace ridgecraft;

namespace {

using Points = std::vector<Vec3>;
using Faces = std::vector<std::array<VertexId, 3>>;

/// A ball whose vertices are pushed in and out: not convex anywhere near.
mesh::Surface bumpy_ball(std::uint64_t seed) {
  const mesh::Surface ball = test::sphere(14, 8);
  Random random(seed);
  Points points;
  for (const Vec3 p : ball.points()) {
    points.push_back((40.0 + 40.0 * random.unit()) * p);
  }
  Faces faces;
  for (const FaceId f : ids<FaceId>(ball.face_count())) {
    faces.push_back(ball.vertices(f));
  }
  return {std::move(points), std::move(faces)};
}

unfold::NetFound search(const mesh::Surface& s, std::uint64_t seed) {
  return test::net_of(test::whole_patch(s), seed);
}

/// The same shape otherwise put: turned, scaled, renumbered, or mirrored (with its faces turned round).
mesh::Surface changed(const mesh::Surface& s, int how) {
  Random random(5);
  std::vector<std::uint32_t> number(s.vertex_count());
  for (std::uint32_t v = 0; v < number.size(); ++v) {
    number[v] = v;
  }
  std::vector<FaceId> order;
  for (const FaceId f : ids<FaceId>(s.face_count())) {
    order.push_back(f);
  }
  if (how == 2) {
    unfold::shuffle(number, random);
    unfold::shuffle(order, random);
  }
  Points points(s.vertex_count());
  for (std::uint32_t v = 0; v < number.size(); ++v) {
    const Vec3 p = s.point(VertexId(v));
    Vec3& q = points[number[v]];
    switch (how) {
      case 0:
        q = {0.6 * p.x - 0.8 * p.y, 0.8 * p.x + 0.6 * p.y, p.z};
        break;
      case 1:
        q = 1e-3 * p;
        break;
      case 3:
        q = {-p.x, p.y, p.z};
        break;
      default:
        q = p;
        break;
    }
  }
  Faces faces;
  for (const FaceId f : order) {
    auto [a, b, c] = s.vertices(f);
    if (how == 3) {
      std::swap(b, c);
    }
    faces.push_back({VertexId(number[a.value()]), VertexId(number[b.value()]), VertexId(number[c.value()])});
  }
  return {std::move(points), std::move(faces)};
}

}  // namespace

TEST_CASE("bumpy balls unfold into one net, however they are put", "[search]") {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const mesh::Surface ball = bumpy_ball(seed);
    CHECK(search(ball, seed).overlaps == 0);
    for (const int how : {0, 1, 2, 3}) {
      INFO("seed " << seed << ", change " << how);
      CHECK(search(changed(ball, how), seed).overlaps == 0);
    }
  }
}

TEST_CASE("one seed gives one tree", "[search]") {
  const mesh::Surface ball = bumpy_ball(4);
  CHECK(search(ball, 9).folds == search(ball, 9).folds);
}

TEST_CASE("the search's count is that of a fresh layout after every stretch of moves", "[search]") {
  const mesh::Surface ball = bumpy_ball(6);
  const unfold::Patch patch = test::whole_patch(ball);
  const double tolerance = 1e-7 * patch.extent;
  Random random(2);
  unfold::NetWalk walk(patch, {tolerance}, 11);
  for (int start = 0; start < 4; ++start) {
    walk.set_tree(test::random_tree(patch, random));
    for (int stretch = 0; stretch < 30 && walk.pairs() > 0; ++stretch) {
      const unfold::Layout layout = unfold::lay_out(patch, walk.folds());
      REQUIRE(layout.faces.size() == 1);
      REQUIRE(unfold::find_overlaps(layout, tolerance).size() == walk.pairs());
      walk.cool({1.0, 1.0, 1 + random.below(40)}, {});
    }
    REQUIRE(unfold::find_overlaps(unfold::lay_out(patch, walk.best()), tolerance).size() == walk.least());
  }
}

TEST_CASE("spiky bodies become one net with every seed", "[spiky][slow]") {
  for (const bench::SpikyBody& body : bench::spiky_family()) {
    for (const std::uint64_t seed : {1U, 2U}) {
      INFO(body.name << ", seed " << seed);
      CHECK(search(body.surface, seed).overlaps == 0);
    }
  }
}

TEST_CASE("a search finds what it counts, and the same for one seed", "[spiky]") {
  const unfold::Patch patch = test::whole_patch(bench::spiky_ball(1, 64, 2.5, 3));
  Random random(1);
  const unfold::Folds start = unfold::start_tree(patch, random);
  const auto found_again = [&] { return unfold::find_net(patch, start, test::tolerance, 7, {}); };
  const unfold::NetFound found = found_again();
  CHECK(unfold::find_overlaps(unfold::lay_out(patch, found.folds), test::tolerance).size() == found.overlaps);
  CHECK(unfold::lay_out(patch, found.folds).faces.size() == 1);
  CHECK(found_again().folds == found.folds);
}

TEST_CASE("spiky bodies have the faces that their names tell", "[spiky]") {
  for (const bench::SpikyBody& body : bench::spiky_family()) {
    CHECK(body.name.ends_with(" " + std::to_string(body.surface.face_count())));
    CHECK(body.surface.component_count() == 1);
    CHECK(2 * body.surface.edge_count() == 3 * body.surface.face_count());  // closed
  }
}

TEST_CASE("turned rectangles fit the sheet they are made for and no smaller one", "[sheet]") {
  Random random(8);
  for (int i = 0; i < 200; ++i) {
    const double width = 50.0 + 100.0 * random.unit();
    const double height = 50.0 + 100.0 * random.unit();
    const double angle = 7.0 * random.unit();
    std::vector<Vec2> corners;
    for (const Vec2 p : {Vec2{0, 0}, Vec2{width, 0}, Vec2{width, height}, Vec2{0, height}}) {
      corners.push_back(
          {std::cos(angle) * p.x - std::sin(angle) * p.y, std::sin(angle) * p.x + std::cos(angle) * p.y});
    }
    const auto hull = convex_hull(corners);
    CHECK(angle_to_fit(hull, {width, height}).has_value());
    CHECK(angle_to_fit(hull, {height, width}).has_value());
    CHECK_FALSE(angle_to_fit(hull, {width - 0.01, height - 0.01}).has_value());
  }
}

TEST_CASE("a long strip fits a sheet only along its diagonal", "[sheet]") {
  // 240 by 1 in a sheet of 200 by 150, diagonal 250: no turn along an axis holds it.
  const std::vector<Vec2> strip{{0, 0}, {240, 0}, {240, 1}, {0, 1}};
  CHECK(angle_to_fit(strip, {200, 150}).has_value());
  CHECK_FALSE(angle_to_fit(strip, {200, 100}).has_value());
}
