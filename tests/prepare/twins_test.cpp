// SPDX-License-Identifier: GPL-3.0-or-later
// Equal bodies are found wherever they lie, and nothing else is.
#include "prepare/symmetry/twins.hpp"

#include <cmath>

#include "prepare/symmetry/mirrors.hpp"
#include "support/concave_shapes.hpp"
#include "support/shapes.hpp"
#include "support/soups.hpp"

using namespace ridgecraft;
using prepare::Twin;

namespace {

Vec3 turned(Vec3 p, double angle, Vec3 shift) {
  Motion m = turn_about({0.1, 0.4}, {0.6, 0.8}, angle);
  m.rows = {m.rows[1], m.rows[2], m.rows[0]};
  return m(p) + shift;
}

/// No symmetry at all.
mesh::Surface odd() {
  return test::mapped(test::sphere(10, 7), [](Vec3 p) {
    return Vec3{p.x * (1.0 + 0.3 * p.z + 0.2 * p.y), 1.7 * p.y + 0.3 * p.x * p.z, p.z + 0.2 * p.y * p.y};
  });
}

mesh::Surface wheel() {
  return test::revolve({{0, 0}, {1, 0}, {1.2, 0.2}, {1, 0.4}, {0, 0.4}}, 16);
}

mesh::Surface placed(const mesh::Surface& s, double angle, Vec3 shift) {
  return test::mapped(s, [&](Vec3 p) { return turned(p, angle, shift); });
}

mesh::Surface mirrored(const mesh::Surface& s) {
  std::vector<std::array<VertexId, 3>> faces;
  std::vector<Vec3> points;
  for (const Vec3 p : s.points()) {
    points.push_back({-p.x, p.y, p.z});
  }
  for (const FaceId f : ids<FaceId>(s.face_count())) {
    const auto [a, b, c] = s.vertices(f);
    faces.push_back({a, c, b});
  }
  return {points, faces};
}

std::vector<std::vector<Twin>> twins(const mesh::Surface& s) {
  return prepare::find_twins(s, prepare::components(s), {});
}

void check(const mesh::Surface& s, const Twin& t, double tolerance) {
  for (const auto& [v, w] : t.vertices) {
    CHECK(length(t.motion(s.point(v)) - s.point(w)) <= tolerance);
  }
  for (const auto& [e, g] : t.edges) {
    CHECK(s.length(e) == Approx(s.length(g)).margin(2.0 * tolerance));
    CHECK(s.fold_angle(e) == Approx(s.fold_angle(g)).margin(0.01));
  }
  for (const auto& [f, g] : t.faces) {
    CHECK(s.area(f) == Approx(s.area(g)).margin(1e-3));
  }
}

}  // namespace

TEST_CASE("wheels and odd bodies find their twins, mirrored ones too, however they lie", "[symmetry]") {
  const mesh::Surface all = test::shuffled(
      test::together({odd(), placed(wheel(), 0.3, {5, 0, 0}), placed(odd(), 1.1, {0, 9, 3}),
                      placed(wheel(), 2.0, {0, 0, 8}), placed(mirrored(odd()), 0.4, {-7, 0, 0}),
                      placed(wheel(), 2.9, {9, 9, 9}), placed(test::cube(), 0.2, {20, 0, 0})}),
      11);
  const std::vector<std::vector<Twin>> found = twins(all);
  REQUIRE(found.size() == 2);
  std::size_t mirrors = 0;
  for (const std::vector<Twin>& group : found) {
    REQUIRE(group.size() == 3);
    CHECK(group[0].deviation == 0.0);
    for (const Twin& t : group) {
      CHECK(t.deviation < 1e-9);
      CHECK(t.whole);
      mirrors += t.motion.mirrors ? 1U : 0U;
      check(all, t, 1e-9);
    }
  }
  // One of the odd bodies against the two others, whichever comes first.
  CHECK(mirrors >= 1);
  CHECK(mirrors <= 2);
}

TEST_CASE("bodies that differ in size or shape are no twins", "[symmetry]") {
  const mesh::Surface dented = test::mapped(wheel(), [](Vec3 p) {
    return p.x > 1.1 ? p - Vec3{0.1, 0, 0} : p;
  });
  CHECK(twins(test::together({wheel(), placed(test::scaled(wheel(), 1.01), 0.5, {5, 0, 0})})).empty());
  CHECK(twins(test::together({wheel(), placed(dented, 0.5, {5, 0, 0})})).empty());
  CHECK(twins(test::together({wheel(), placed(odd(), 0.5, {5, 0, 0})})).empty());
}

TEST_CASE("parts of one component may be twins", "[symmetry]") {
  // The two halves of a sphere.
  const mesh::Surface s = test::sphere(12, 8);
  std::vector<std::vector<FaceId>> halves(2);
  for (const FaceId f : ids<FaceId>(s.face_count())) {
    const auto [a, b, c] = s.vertices(f);
    halves[s.point(a).z + s.point(b).z + s.point(c).z > 0.0 ? 0 : 1].push_back(f);
  }
  const std::vector<std::vector<Twin>> found = prepare::find_twins(s, halves, {});
  REQUIRE(found.size() == 1);
  CHECK(found[0].size() == 2);
  check(s, found[0][1], 1e-9);
}
