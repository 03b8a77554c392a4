// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/net/outline.hpp"

#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

#include "base/geometry.hpp"
#include "support/shapes.hpp"
#include "unfold/tree_nets.hpp"

using namespace ridgecraft;
using mesh::Surface;
using unfold::EdgeUse;
using unfold::Nets;

namespace {

using Loop = std::vector<Vec2>;

double perimeter(const Loop& loop) {
  double sum = 0.0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    sum += length(loop[(i + 1) % loop.size()] - loop[i]);
  }
  return sum;
}

double line_length(const Loop& line) {
  double sum = 0.0;
  for (std::size_t i = 1; i < line.size(); ++i) {
    sum += length(line[i] - line[i - 1]);
  }
  return sum;
}

double area_of_faces(const Surface& s) {
  double sum = 0.0;
  for (const FaceId f : ids<FaceId>(s.face_count())) {
    sum += s.area(f);
  }
  return sum;
}

double area_inside(const std::vector<Loop>& loops) {
  double sum = 0.0;
  for (const Loop& loop : loops) {
    sum += 0.5 * doubled_area(loop);
  }
  return sum;
}

double length_of_boundary(const Surface& s, const Nets& nets) {
  double sum = 0.0;
  for (const EdgeId e : ids<EdgeId>(s.edge_count())) {
    sum += nets.use[e] == EdgeUse::fold ? 0.0 : (nets.use[e] == EdgeUse::cut ? 2.0 : 1.0) * s.length(e);
  }
  return sum;
}

/// Do two segments cross, touch or lie on each other? Tolerance in mm.
bool meet(Vec2 a, Vec2 b, Vec2 c, Vec2 d, double tolerance) {
  const auto distance = [](Vec2 p, Vec2 u, Vec2 v) {
    const double t = std::clamp(dot(p - u, v - u) / dot(v - u, v - u), 0.0, 1.0);
    return length(p - (u + t * (v - u)));
  };
  if (cross(b - a, c - a) * cross(b - a, d - a) < 0.0 && cross(d - c, a - c) * cross(d - c, b - c) < 0.0) {
    return true;
  }
  return distance(a, c, d) < tolerance || distance(b, c, d) < tolerance || distance(c, a, b) < tolerance ||
         distance(d, a, b) < tolerance;
}

bool is_simple(const Loop& loop) {
  const std::size_t n = loop.size();
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 2; j < n; ++j) {
      if ((j + 1) % n != i && meet(loop[i], loop[i + 1], loop[j], loop[(j + 1) % n], 1e-4)) {
        return false;
      }
    }
  }
  return n >= 3;
}

/// What must hold of every piece without overlap.
void check_outline(const Surface& s, const Nets& nets) {
  REQUIRE(nets.pieces.size() == 1);
  const auto exact = unfold::outline(s, nets, PieceId(0));
  const unfold::CutLines lines = unfold::cut_lines(s, nets, PieceId(0));
  double cut = 0.0;
  for (const Loop& loop : exact) {
    cut += perimeter(loop);
  }
  CHECK(cut == Approx(length_of_boundary(s, nets)));
  CHECK(area_inside(exact) == Approx(area_of_faces(s)));
  CHECK(doubled_area(exact[0]) > 0.0);

  double once = 0.0;
  for (std::size_t i = 0; i < lines.loops.size(); ++i) {
    CHECK((doubled_area(lines.loops[i]) > 0.0) == (i == 0));
    CHECK(is_simple(lines.loops[i]));
    once += perimeter(lines.loops[i]);
  }
  for (const Loop& slit : lines.slits) {
    once += 2.0 * line_length(slit);
  }
  // Each corner may have moved by the tolerance.
  CHECK(once == Approx(cut).margin(1e-2));
  CHECK(area_inside(lines.loops) == Approx(area_of_faces(s)).margin(1e-2 * cut));
}

}  // namespace

TEST_CASE("the outline of a cube's net is one simple loop", "[outline]") {
  const Surface cube = test::scaled(test::cube(), 40.0);
  const Nets nets = test::lay_out(cube, test::breadth_first(cube));
  REQUIRE_FALSE(test::faces_overlap(nets));
  check_outline(cube, nets);
  CHECK(unfold::outline(cube, nets, PieceId(0)).size() == 1);
}

TEST_CASE("outlines of convex hulls keep length and area", "[outline]") {
  int clean = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Surface hull = test::scaled(test::random_hull(8 + static_cast<int>(seed), seed), 60.0);
    const Nets nets = test::lay_out(hull, test::steepest_edge(hull, seed));
    if (!test::faces_overlap(nets)) {
      ++clean;
      check_outline(hull, nets);
      CHECK(unfold::cut_lines(hull, nets, PieceId(0)).loops.size() == 1);
    }
  }
  CHECK(clean >= 10);
}

TEST_CASE("a slit that lies closed is run there and back, and drawn once", "[outline]") {
  // A flat grid cut from its border to its middle.
  const Surface grid = test::scaled(test::flat_grid(4), 10.0);
  std::vector<EdgeId> cuts;
  for (const unsigned x : {0U, 1U}) {
    cuts.push_back(test::edge_between(grid, VertexId(10 + x), VertexId(11 + x)));
  }
  const Nets nets = [&] {
    Nets n = test::lay_out(grid, test::random_order(grid, 1), cuts);
    // Every edge but the two is flat and becomes a fold: the piece is a disc with circles of folds.
    for (const EdgeId e : ids<EdgeId>(grid.edge_count())) {
      if (n.use[e] == EdgeUse::cut && std::find(cuts.begin(), cuts.end(), e) == cuts.end()) {
        n.use[e] = EdgeUse::fold;
      }
    }
    return n;
  }();
  const auto exact = unfold::outline(grid, nets, PieceId(0));
  REQUIRE(exact.size() == 1);
  CHECK(exact[0].size() == 16 + 4);
  const unfold::CutLines lines = unfold::cut_lines(grid, nets, PieceId(0));
  REQUIRE(lines.loops.size() == 1);
  REQUIRE(lines.slits.size() == 1);
  CHECK(lines.slits[0].size() == 3);
  check_outline(grid, nets);
}

TEST_CASE("a spanning tree of a flat grid has slits everywhere", "[outline]") {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const Surface grid = test::scaled(test::flat_grid(6), 7.0);
    const Nets nets = test::lay_out(grid, test::random_order(grid, seed));
    check_outline(grid, nets);
    const unfold::CutLines lines = unfold::cut_lines(grid, nets, PieceId(0));
    CHECK(lines.loops.size() == 1);
    CHECK(perimeter(lines.loops[0]) == Approx(4 * 42.0));
  }
}

TEST_CASE("a flat ring has an outer loop and a hole", "[outline]") {
  std::vector<Vec3> points;
  std::vector<std::array<VertexId, 3>> faces;
  for (const double r : {30.0, 10.0}) {
    for (const auto& [x, y] : {std::pair{1, 1}, std::pair{-1, 1}, std::pair{-1, -1}, std::pair{1, -1}}) {
      points.push_back({r * x, r * y, 0.0});
    }
  }
  for (unsigned i = 0; i < 4; ++i) {
    const unsigned j = (i + 1) % 4;
    faces.push_back({VertexId(i), VertexId(j), VertexId(4 + j)});
    faces.push_back({VertexId(i), VertexId(4 + j), VertexId(4 + i)});
  }
  const Surface ring(points, faces);
  Nets nets = test::lay_out(ring, test::breadth_first(ring));
  SECTION("cut open once: it touches itself along the cut") {
    check_outline(ring, nets);
    CHECK(unfold::outline(ring, nets, PieceId(0)).size() == 1);
    const unfold::CutLines lines = unfold::cut_lines(ring, nets, PieceId(0));
    CHECK(lines.loops.size() == 2);
    CHECK(lines.slits.size() == 1);
  }
  SECTION("not cut at all") {
    for (const EdgeId e : ids<EdgeId>(ring.edge_count())) {
      nets.use[e] = nets.use[e] == EdgeUse::cut ? EdgeUse::fold : nets.use[e];
    }
    const auto loops = unfold::outline(ring, nets, PieceId(0));
    REQUIRE(loops.size() == 2);
    CHECK(doubled_area(loops[0]) == Approx(2 * 3600.0));
    CHECK(doubled_area(loops[1]) == Approx(-2 * 400.0));
    check_outline(ring, nets);
  }
}

TEST_CASE("a tab is spliced into the outline", "[outline]") {
  const Surface cube = test::scaled(test::cube(), 40.0);
  Nets nets = test::lay_out(cube, test::breadth_first(cube));
  const std::size_t before = unfold::outline(cube, nets, PieceId(0))[0].size();
  const double area = area_of_faces(cube);
  const CornerId side = cube.sides(nets.joins[JoinId(0)].edge)[0];
  const auto& flat = nets.flat[mesh::face_of(side)];
  const Vec2 a = flat[side.value() % 3];
  const Vec2 b = flat[mesh::next(side).value() % 3];
  const Vec2 x = (b - a) / length(b - a);
  const Vec2 out = -perpendicular(x);
  const bool whole = GENERATE(true, false);
  const double left = whole ? 0.0 : 3.0;
  unfold::Tab tab;
  tab.side = side;
  tab.join = JoinId(0);
  tab.polygon = {b, a + left * x, a + (left + 5.0) * x + 5.0 * out, b - 5.0 * x + 5.0 * out};
  nets.tabs.push_back(tab);
  nets.joins[JoinId(0)].tab = TabId(0);
  const auto loops = unfold::outline(cube, nets, PieceId(0));
  CHECK(loops[0].size() == before + (whole ? 2 : 3));
  CHECK(area_inside(loops) == Approx(area + 0.5 * doubled_area(tab.polygon)));
  const Box2 box = unfold::extent(cube, nets, PieceId(0));
  for (const Vec2 p : tab.polygon) {
    CHECK((p.x >= box.low.x && p.x <= box.high.x && p.y >= box.low.y && p.y <= box.high.y));
  }
}
