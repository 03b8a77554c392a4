// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include "base/context.hpp"
#include "base/delaunay.hpp"
#include "base/vector.hpp"
#include "segment/hierarchy.hpp"
#include "segment/segment.hpp"

namespace ridgecraft::test {
namespace {

// Outlines of capital letters and floor plans, and into how many parts prisms over them are cut. A person
// would cut C into 3, E 4, G 4, H 3, J 3, M 4, S 5 and W 4: where both ends of a notch lie on the hull's flat
// sides, the way around it along a rim isn't deep (docs/design/segmentation.md, "Limits").

struct Letter {
  std::string name;
  std::vector<Vec2> outline;  ///< counterclockwise
  std::size_t fewest = 1;
  std::size_t most = 1;
};

/// Those of straight strokes that enclose nothing.
std::vector<Letter> letters() {
  return {
      {"C", {{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 4}, {3, 4}, {3, 5}, {0, 5}}, 2, 3},
      {"E",
       {{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 2}, {2.5, 2}, {2.5, 3}, {1, 3}, {1, 4}, {3, 4}, {3, 5}, {0, 5}},
       3,
       4},
      {"F", {{0, 0}, {1, 0}, {1, 2}, {2.5, 2}, {2.5, 3}, {1, 3}, {1, 4}, {3, 4}, {3, 5}, {0, 5}}, 3, 3},
      {"G",
       {{0, 0},
        {4, 0},
        {4, 2.5},
        {2, 2.5},
        {2, 1.7},
        {3, 1.7},
        {3, 1},
        {1, 1},
        {1, 4},
        {4, 4},
        {4, 5},
        {0, 5}},
       2,
       5},
      {"H",
       {{0, 0}, {1, 0}, {1, 2}, {2, 2}, {2, 0}, {3, 0}, {3, 5}, {2, 5}, {2, 3}, {1, 3}, {1, 5}, {0, 5}},
       3,
       5},
      {"I", {{0, 0}, {1, 0}, {1, 5}, {0, 5}}, 1, 1},
      {"J", {{0, 0}, {3, 0}, {3, 5}, {2, 5}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}, 1, 3},
      {"K",
       {{0, 0}, {1, 0}, {1, 2}, {2.6, 0}, {4, 0}, {2, 2.5}, {4, 5}, {2.6, 5}, {1, 3}, {1, 5}, {0, 5}},
       3,
       3},
      {"M",
       {{0, 0}, {1, 0}, {1, 3}, {2.5, 1}, {4, 3}, {4, 0}, {5, 0}, {5, 5}, {4, 5}, {2.5, 3}, {1, 5}, {0, 5}},
       3,
       4},
      {"N", {{0, 0}, {1, 0}, {1, 3}, {3, 0}, {4, 0}, {4, 5}, {3, 5}, {3, 2}, {1, 5}, {0, 5}}, 3, 3},
      {"S",
       {{0, 0}, {3, 0}, {3, 3}, {1, 3}, {1, 4}, {3, 4}, {3, 5}, {0, 5}, {0, 2}, {2, 2}, {2, 1}, {0, 1}},
       4,
       5},
      {"W",
       {{1, 0},
        {2, 0},
        {3, 3},
        {4, 0},
        {5, 0},
        {6, 5},
        {5, 5},
        {4.5, 2},
        {3.5, 5},
        {2.5, 5},
        {1.5, 2},
        {1, 5},
        {0, 5}},
       3,
       4},
      {"X",
       {{0, 0},
        {1, 0},
        {2, 1.7},
        {3, 0},
        {4, 0},
        {2.6, 2.5},
        {4, 5},
        {3, 5},
        {2, 3.3},
        {1, 5},
        {0, 5},
        {1.4, 2.5}},
       3,
       5},
      {"Y", {{1.5, 0}, {2.5, 0}, {2.5, 2}, {4, 5}, {3, 5}, {2, 3}, {1, 5}, {0, 5}, {1.5, 2}}, 2, 3},
      {"bracket", {{0, 0}, {5, 0}, {5, 0.6}, {0.6, 0.6}, {0.6, 5}, {0, 5}}, 2, 2},
      {"house with a wing", {{0, 0}, {6, 0}, {6, 3}, {4, 3}, {4, 6}, {2, 6}, {2, 3}, {0, 3}}, 2, 2},
  };
}

}  // namespace

}  // namespace ridgecraft::test

namespace ridgecraft {
namespace {

// Prisms over letters and floor plans: all their corners lie on the hull's flat sides, and their notches
// count all the same.

using Outline = std::vector<Vec2>;

struct Mesh {
  std::vector<Vec3> points;
  std::vector<std::array<VertexId, 3>> faces;

  [[nodiscard]] mesh::Surface surface() const { return {points, faces}; }
};

Mesh prism(const Outline& outline, double height) {
  Mesh mesh;
  const auto n = static_cast<std::uint32_t>(outline.size());
  std::vector<std::array<std::uint32_t, 2>> sides;
  for (const double z : {0.0, height}) {
    for (const Vec2 p : outline) {
      mesh.points.push_back({p.x, p.y, z});
    }
  }
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    mesh.faces.push_back({VertexId(a), VertexId(b), VertexId(c)});
  };
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t j = (i + 1) % n;
    sides.push_back({i, j});
    add(i, j, j + n);
    add(i, j + n, i + n);
  }
  const auto lid = triangulate_inside(outline, sides);
  REQUIRE(lid);
  for (const auto& [a, b, c] : *lid) {
    add(c, b, a);
    add(a + n, b + n, c + n);
  }
  return mesh;
}

/// Every triangle becomes four.
Mesh subdivided(const Mesh& mesh) {
  Mesh result{mesh.points, {}};
  std::map<std::pair<VertexId, VertexId>, VertexId> middles;
  const auto middle = [&](VertexId a, VertexId b) {
    const auto [at, fresh] = middles.try_emplace(std::minmax(a, b), result.points.size());
    if (fresh) {
      result.points.push_back(0.5 * (mesh.points[a.value()] + mesh.points[b.value()]));
    }
    return at->second;
  };
  for (const auto& [a, b, c] : mesh.faces) {
    const VertexId ab = middle(a, b);
    const VertexId bc = middle(b, c);
    const VertexId ca = middle(c, a);
    result.faces.insert(result.faces.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
  }
  return result;
}

std::size_t parts(const Mesh& mesh) {
  return segment::segment(mesh.surface(), {}, {}, Context()).parts.size();
}

/// Of the whole as one part.
double concavity(const Mesh& mesh) {
  segment::Options options;
  options.concavity = 1.99;
  return segment::segment(mesh.surface(), {}, options, Context()).max_concavity();
}

const Outline l{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
const Outline u{{0, 0}, {3, 0}, {3, 3}, {2, 3}, {2, 1}, {1, 1}, {1, 3}, {0, 3}};
const Outline t{{1, 0}, {2, 0}, {2, 2}, {3, 2}, {3, 3}, {0, 3}, {0, 2}, {1, 2}};
const Outline plus{{1, 0}, {2, 0}, {2, 1}, {3, 1}, {3, 2}, {2, 2},
                   {2, 3}, {1, 3}, {1, 2}, {0, 2}, {0, 1}, {1, 1}};
const Outline v{{1, 0}, {2, 0}, {3, 4}, {2.2, 4}, {1.5, 1}, {0.8, 4}, {0, 4}};
const Outline stairs{{0, 0}, {4, 0}, {4, 4}, {3, 4}, {3, 3}, {2, 3}, {2, 2}, {1, 2}, {1, 1}, {0, 1}};
const Outline z{{0, 0}, {3, 0}, {3, 0.8}, {1, 0.8}, {3, 3.2}, {3, 4}, {0, 4}, {0, 3.2}, {2, 3.2}, {0, 0.8}};

Outline star() {
  Outline outline;
  for (int i = 0; i < 10; ++i) {
    const double r = i % 2 == 0 ? 1.0 : 0.45;
    outline.push_back({r * std::cos(std::numbers::pi * i / 5), r * std::sin(std::numbers::pi * i / 5)});
  }
  return outline;
}

/// Half a ring of twelve steps.
Outline arch() {
  Outline outline;
  for (int i = 0; i <= 24; ++i) {
    const double r = i <= 12 ? 2.0 : 1.4;
    const double at = std::numbers::pi * (i <= 12 ? i : 24.5 - i) / 12.0;
    outline.push_back({r * std::cos(at), r * std::sin(at)});
  }
  return outline;
}

struct Case {
  std::string name;
  Outline outline;
  double height = 1.0;
  std::size_t fewest = 0;
  std::size_t most = 0;
};

std::vector<Case> cases() {
  // Of four steps a part may keep a notch beside an opening that a cut left (docs/design/segmentation.md).
  std::vector<Case> all{{"L", l, 1.0, 2, 2},           {"thin L", l, 0.1, 2, 2},  {"U", u, 1.0, 3, 3},
                        {"T", t, 1.0, 2, 2},           {"plus", plus, 1.0, 3, 5}, {"V", v, 0.7, 2, 3},
                        {"stairs", stairs, 2.0, 2, 4}, {"Z", z, 1.0, 3, 3},       {"star", star(), 0.5, 3, 6},
                        {"arch", arch(), 1.0, 2, 5}};
  for (const test::Letter& letter : test::letters()) {
    all.push_back({letter.name, letter.outline, 1.0, letter.fewest, letter.most});
  }
  return all;
}

}  // namespace

TEST_CASE("prisms without a point between their flat sides have the parts that a person would give") {
  for (const Case& c : cases()) {
    CAPTURE(c.name);
    const std::size_t n = parts(prism(c.outline, c.height));
    CHECK(n >= c.fewest);
    CHECK(n <= c.most);
  }
}

TEST_CASE("the notch of an L measures half the hull's face over it, whatever the points") {
  // Smallest ball: through four corners of the box of 2 x 2 x 1.
  const double notch = std::sqrt(0.5) / 1.5;
  Mesh mesh = prism(l, 1.0);
  for (int i = 0; i < 4; ++i) {
    CHECK(concavity(mesh) == Approx(notch).epsilon(0.001));
    mesh = subdivided(mesh);
  }
}

TEST_CASE("a prism has the same parts, and is as concave, with its triangles divided as without") {
  for (const Case& c : cases()) {
    CAPTURE(c.name);
    const Mesh plain = prism(c.outline, c.height);
    const segment::Segmentation whole = segment::segment(plain.surface(), {}, {}, Context());
    Mesh finer = plain;
    for (std::size_t pieces = 4; pieces <= 16; pieces *= 4) {
      finer = subdivided(finer);
      CHECK(concavity(finer) == Approx(concavity(plain)).epsilon(1e-9));
      const segment::Segmentation s = segment::segment(finer.surface(), {}, {}, Context());
      REQUIRE(s.parts.size() == whole.parts.size());
      for (const FaceId f : ids<FaceId>(finer.faces.size())) {
        CHECK(s.part[f] == whole.part[FaceId(f.value() / pieces)]);
      }
    }
  }
}

TEST_CASE("points that bend a flat face aside, or divide one side alone, stay") {
  const Mesh plain = subdivided(prism(l, 1.0));
  // One middle is moved a thousandth: no triangle of the whole is left there.
  Mesh bent = plain;
  bent.points.back().z += 1e-3;
  const double flat = concavity(plain);
  CHECK(concavity(bent) == Approx(flat).epsilon(0.1));
  const segment::Segmentation s = segment::segment(bent.surface(), {}, {}, Context());
  CHECK(s.part.size() == bent.faces.size());
}

TEST_CASE("labels and hulls of a prism are those of the faces and points as given") {
  const Mesh mesh = prism(t, 1.0);
  const segment::Segmentation s = segment::segment(mesh.surface(), {}, {}, Context());
  REQUIRE(s.part.size() == mesh.faces.size());
  std::size_t faces = 0;
  for (const segment::Part& part : s.parts) {
    faces += part.faces.size();
    CHECK(part.faces.back().value() < mesh.faces.size());
    CHECK(part.hull_vertices.back().value() < mesh.points.size());
    CHECK(part.hull_vertices.size() >= 8);
  }
  CHECK(faces == mesh.faces.size());
}

TEST_CASE("the parts of a prism join at the concavity of their notches") {
  const Mesh mesh = prism(l, 1.0);
  const segment::Hierarchy hierarchy = segment::find_hierarchy(mesh.surface(), {}, 2, Context());
  CHECK(hierarchy.faces == mesh.faces.size());
  REQUIRE(hierarchy.fewest() == 1);
  CHECK(hierarchy.joinings.back().concavity == Approx(std::sqrt(0.5) / 1.5).epsilon(0.01));
  CHECK(hierarchy.parts(2).part.size() == mesh.faces.size());
}

}  // namespace ridgecraft
