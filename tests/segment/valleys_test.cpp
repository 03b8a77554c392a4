// SPDX-License-Identifier: GPL-3.0-or-later
// Valleys and their concavity: found, measured as chains (t, h), divided (docs/design/segmentation.md,
// "Depth of a valley" and "Separators").
#include "segment/concavity/valleys.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include <catch2/catch.hpp>

#include "base/context.hpp"
#include "base/random.hpp"
#include "segment/concavity/valley_search.hpp"
#include "segmented.hpp"
#include "support/concave_shapes.hpp"
#include "support/shapes.hpp"

namespace ridgecraft {

TEST_CASE("searching on from a vertex finds the way and the length that a fresh search finds") {
  // A torus and a flat grid have many ways of one length; half a sphere has a cut loop to jump across.
  const mesh::Surface grid = test::voxels({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, 12);
  for (const mesh::Surface& surface : {test::torus(1.0, 0.3, 16, 40), grid, test::sphere(40, 20)}) {
    const segment::ScaledSurface scaled = segment::scale_surface(surface, {});
    const segment::VertexGraph graph = segment::build_vertex_graph(scaled, 0.025);
    for (const bool jumps : {false, true}) {
      segment::PartGraph part(scaled, graph, jumps);
      std::vector<std::uint32_t> facets(jumps ? scaled.facet_count() / 2 : scaled.facet_count());
      std::iota(facets.begin(), facets.end(), 0U);
      part.select(facets);
      const auto vertices = part.vertices();
      Random random(7);
      segment::ValleySearch kept(part);
      std::vector<segment::Step> path;
      std::vector<segment::Step> fresh_path;
      for (int source = 0; source < 12; ++source) {
        const std::uint32_t from = vertices[random.below(static_cast<std::uint32_t>(vertices.size()))];
        for (int goal = 0; goal < 20; ++goal) {
          const std::uint32_t to = vertices[random.below(static_cast<std::uint32_t>(vertices.size()))];
          segment::ValleySearch fresh(part);
          const double length = kept.find(from, to, path);
          CAPTURE(source, goal, from, to, jumps);
          REQUIRE(length == fresh.find(from, to, fresh_path));
          bool jumped = false;
          bool same = path.size() == fresh_path.size();
          for (std::size_t i = 0; same && i < path.size(); ++i) {
            same = path[i].vertex == fresh_path[i].vertex;
          }
          for (const auto& steps : {path, fresh_path}) {
            for (const segment::Step& step : steps) {
              jumped = jumped || step.arc == segment::jump_arc;
            }
          }
          // Of jumps of one length, the one that was found first.
          CHECK((same || jumped));
        }
      }
    }
  }
}

namespace {

// Concavity, residual concavity and separators of valleys given as chains (t, h):
// docs/design/segmentation.md, "Depth of a valley" and "Separators".

using test::tolerance;

std::vector<double> concavity_of(const std::vector<Vec2>& chain) {
  std::vector<double> c;
  segment::chain_concavity(chain, c);
  return c;
}

segment::Separators separators_of(const std::vector<Vec2>& chain) {
  const auto concavity = concavity_of(chain);
  return segment::find_separators(chain, concavity, concavity, tolerance);
}

double greatest(const std::vector<double>& values) {
  return *std::max_element(values.begin(), values.end());
}

std::vector<Vec2> half_circle(int n) {
  std::vector<Vec2> chain;
  for (int i = 0; i <= n; ++i) {
    const double angle = std::numbers::pi * i / n;
    chain.push_back({1.0 - std::cos(angle), i == 0 || i == n ? 0.0 : std::sin(angle)});
  }
  return chain;
}

/// Points along straight pieces, about `step` apart.
std::vector<Vec2> along(const std::vector<Vec2>& corners, double step) {
  std::vector<Vec2> chain{corners.front()};
  for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
    const Vec2 way = corners[i + 1] - corners[i];
    const int pieces = std::max(1, static_cast<int>(std::lround(length(way) / step)));
    for (int k = 1; k <= pieces; ++k) {
      chain.push_back(k == pieces ? corners[i + 1] : corners[i] + (static_cast<double>(k) / pieces) * way);
    }
  }
  return chain;
}

/// prefix(k) by the definition: all segments of the lower hull of q_0..q_k, found by brute force over
/// monotone chains.
double prefix_by_definition(const std::vector<Vec2>& chain, std::size_t k) {
  std::vector<std::size_t> hull;
  for (std::size_t i = 0; i <= k; ++i) {
    bool on_hull = true;
    for (std::size_t a = 0; a < i && on_hull; ++a) {
      for (std::size_t b = i + 1; b <= k && on_hull; ++b) {
        on_hull = cross(chain[i] - chain[a], chain[b] - chain[a]) > 0.0;
      }
    }
    if (on_hull) {
      hull.push_back(i);
    }
  }
  double deepest = 0.0;
  for (std::size_t s = 0; s + 1 < hull.size(); ++s) {
    const Vec2 a = chain[hull[s]];
    const Vec2 d = chain[hull[s + 1]] - a;
    for (std::size_t i = hull[s] + 1; i < hull[s + 1]; ++i) {
      const double t = std::clamp(dot(chain[i] - a, d) / dot(d, d), 0.0, 1.0);
      deepest = std::max(deepest, length(chain[i] - a - t * d));
    }
  }
  return deepest;
}

}  // namespace

TEST_CASE("Half circle") {
  const auto chain = half_circle(64);
  CHECK(greatest(concavity_of(chain)) == Approx(1.0));
  std::vector<double> prefix;
  segment::prefix_concavity(chain, prefix);
  for (std::size_t k = 2; k < chain.size(); k += 2) {
    // Sagitta of the arc so far.
    CHECK(prefix[k] ==
          Approx(1.0 - std::cos(0.5 * std::numbers::pi * static_cast<double>(k) / 64)).margin(1e-12));
  }
}

TEST_CASE("Prefixes are what the definition says") {
  Random random(4);
  for (int round = 0; round < 100; ++round) {
    std::vector<Vec2> chain{{0.0, 0.0}};
    for (int i = 0; i < 25; ++i) {
      chain.push_back({chain.back().x + random.unit(), random.unit()});
    }
    chain.push_back({chain.back().x + 1.0, 0.0});
    std::vector<double> prefix;
    std::vector<double> suffix;
    segment::prefix_concavity(chain, prefix);
    segment::suffix_concavity(chain, suffix);
    std::vector<Vec2> mirrored(chain.rbegin(), chain.rend());
    for (Vec2& p : mirrored) {
      p.x = -p.x;
    }
    for (std::size_t k = 0; k < chain.size(); ++k) {
      REQUIRE(prefix[k] == Approx(prefix_by_definition(chain, k)).margin(1e-12));
      REQUIRE(suffix[k] == Approx(prefix_by_definition(mirrored, chain.size() - 1 - k)).margin(1e-12));
    }
  }
}

TEST_CASE("A symmetric V is cut at its tip") {
  const auto chain = along({{0, 0}, {1, 0.5}, {2, 0}}, 0.1);
  std::vector<double> prefix;
  std::vector<double> suffix;
  segment::prefix_concavity(chain, prefix);
  segment::suffix_concavity(chain, suffix);
  const std::size_t tip = (chain.size() - 1) / 2;
  CHECK(std::max(prefix[tip], suffix[tip]) < 1e-9);
  const auto s = separators_of(chain);
  CHECK(s.v_shaped);
  CHECK(s.first == tip);
  CHECK(s.last == tip);
}

TEST_CASE("A flat-bottomed valley is cut at both of its corners") {
  const auto chain =
      along({{0, 0}, {0, 2.5 * tolerance}, {10 * tolerance, 2.5 * tolerance}, {10 * tolerance, 0}},
            0.5 * tolerance);
  const auto s = separators_of(chain);
  CHECK_FALSE(s.v_shaped);
  CHECK(std::abs(static_cast<int>(s.first) - 5) <= 1);
  CHECK(std::abs(static_cast<int>(s.last) - 25) <= 1);
  const auto slanting = along({{0, 0}, {0.12, 0.12}, {1.12, 0.12}, {1.24, 0}}, 0.04);
  CHECK(separators_of(slanting).v_shaped);
}

TEST_CASE("A hook hides its end: shortest path in the polygon") {
  // Down, to the right, up behind an overhang, back to the left below it.
  const std::vector<Vec2> chain{{0, 0},  {0, 3},   {3, 3},     {3, 1},     {1, 1},     {1, 2},
                                {2, 2},  {2, 1.5}, {1.5, 1.5}, {1.5, 1.2}, {3.5, 1.2}, {3.5, 4},
                                {-1, 4}, {-1, 5},  {5, 5},     {5, 0}};
  // That chain crosses itself at (3, 1.2): the hierarchy answers, and at least with the distance to the
  // bridge.
  const auto crossed = concavity_of(chain);
  for (std::size_t i = 0; i < chain.size(); ++i) {
    CHECK(crossed[i] >= chain[i].y);
  }
  // The same without the crossing: the floor of a cave under an overhang.
  const std::vector<Vec2> cave{{0, 0}, {0, 1}, {2, 1}, {2, 2}, {-2, 2}, {-2, 3}, {3, 3}, {3, 0}};
  const auto depth = concavity_of(cave);
  CHECK(depth[1] == Approx(1.0));
  CHECK(depth[2] == Approx(1.0));
  CHECK(depth[3] == Approx(2.0));
  // (-2, 2) sees nothing of the bridge: along the roof to (2, 2), then straight up.
  CHECK(depth[4] == Approx(4.0 + 2.0));
  CHECK(depth[5] == Approx(std::hypot(4.0, 1.0) + 2.0));
  CHECK(depth[6] == Approx(3.0));
}

TEST_CASE("A spiral of one and a half turns is as deep as the taut string") {
  // Two parallel walls along a spiral; the string from the inner end hugs the inner wall.
  std::vector<Vec2> outer;
  std::vector<Vec2> inner;
  const Vec2 center{5.0, 6.0};
  for (int i = 0; i <= 60; ++i) {
    const double angle = -std::numbers::pi / 2 + 3.0 * std::numbers::pi * i / 60;
    const double radius = 4.0 - 2.4 * i / 60;
    const Vec2 direction{std::cos(angle), std::sin(angle)};
    outer.push_back(center + (radius + 0.15) * direction);
    inner.push_back(center + (radius - 0.15) * direction);
  }
  // The mouth of the spiral opens to the left, above the bridge from (0, 0) to (4, 0).
  std::vector<Vec2> chain{{0.0, 0.0}, {0.0, inner.front().y}};
  chain.insert(chain.end(), inner.begin(), inner.end());
  const std::size_t end = chain.size();
  chain.insert(chain.end(), outer.rbegin(), outer.rend());
  chain.push_back({4.0, 0.0});
  const auto depth = concavity_of(chain);
  double string = 0.0;
  for (std::size_t i = 1; i < inner.size(); ++i) {
    string += length(inner[i] - inner[i - 1]);
  }
  const double to_bridge = length(inner.front() - chain.back());
  const double hugging = string + to_bridge + length(outer.back() - inner.back());
  CHECK(depth[end - 1] == Approx(string + to_bridge).epsilon(0.01));
  CHECK(depth[end] <= hugging + 1e-9);
  CHECK(depth[end] >= 0.95 * hugging);
  CHECK(depth[end] > 2.0 * chain[end].y);
}

TEST_CASE("Valleys in space are projected to their bridge") {
  const std::vector<Vec3> valley{{1, 1, 1}, {2, 1, 0}, {3, 2, 1}, {4, 1, 1}};
  std::vector<Vec2> chain;
  segment::project_valley(valley, chain);
  CHECK(chain[0] == Vec2{0, 0});
  CHECK(chain[1].x == Approx(1.0));
  CHECK(chain[1].y == Approx(1.0));
  CHECK(chain[2].x == Approx(2.0));
  CHECK(chain[2].y == Approx(1.0));
  CHECK(chain[3].x == Approx(3.0));
  CHECK(chain[3].y == 0.0);
  // Beyond an end: distance to the segment, not to the line.
  const std::vector<Vec3> behind{{0, 0, 0}, {-3, 4, 0}, {1, 0, 0}};
  segment::project_valley(behind, chain);
  CHECK(chain[1].x == Approx(-3.0));
  CHECK(chain[1].y == Approx(5.0));
}

namespace {

/// The whole of a dumbbell as a part, and two vertices on its two balls.
struct Whole {
  Whole() {
    std::vector<std::uint32_t> all(scaled.facet_count());
    std::iota(all.begin(), all.end(), 0U);
    part.select(all);
    valleys.select();
    for (std::uint32_t v = 0; v < scaled.vertex_count(); ++v) {
      low = scaled.points[v].x > scaled.points[low].x && scaled.points[v].z < 0.0 ? v : low;
      high = scaled.points[v].x > scaled.points[high].x && scaled.points[v].z > 0.0 ? v : high;
    }
  }
  [[nodiscard]] segment::Valley find() { return valleys.find(low, high, tolerance, false); }

  segment::ScaledSurface scaled = segment::scale_surface(test::dumbbell(), {});
  segment::VertexGraph graph = segment::build_vertex_graph(scaled, 0.025);
  segment::PartGraph part{scaled, graph, true};
  segment::Valleys valleys{part};
  std::uint32_t low = 0;
  std::uint32_t high = 0;
};

}  // namespace

TEST_CASE("Valleys that are found during a loan belong to the lender") {
  Whole whole;
  segment::ValleyCache lent;
  segment::Valley known;
  {
    const segment::ValleyLoan loan(whole.valleys, lent);
    const segment::Valley valley = whole.find();
    REQUIRE(valley.steps.size() > 2);
    CHECK(valley.greatest > tolerance);
    REQUIRE(lent.find(whole.low, whole.high, known));
    CHECK(known.length == valley.length);
  }
  // A tampered copy shows which one is taken: the lender's is out of reach, then lent again by another hand.
  segment::Valley marked = known;
  marked.length = 77.0;
  segment::ValleyCache others;
  others.store(whole.low, whole.high, marked);
  CHECK(whole.find().length == known.length);
  segment::ValleyCache empty;
  {
    const segment::ValleyLoan fresh(whole.valleys, empty, &others);
    CHECK(whole.find().length == 77.0);
    {
      segment::ValleyCache inner;
      const segment::ValleyLoan nested(whole.valleys, inner);
      CHECK(whole.find().length == known.length);
      CHECK(inner.find(whole.low, whole.high, known));
    }
    CHECK(whole.find().length == 77.0);
  }
  CHECK_FALSE(empty.find(whole.low, whole.high, known));
  CHECK(whole.find().length < 77.0);
}

TEST_CASE("A deep valley of another part is searched again where a cut may be jumped across") {
  Whole whole;
  const double length_before = whole.find().length;
  // Without the facets of the far half of one ball: the valley survives, and there is a cut loop.
  std::vector<std::uint32_t> rest;
  for (std::uint32_t f = 0; f < whole.scaled.facet_count(); ++f) {
    const auto& [a, b, c] = whole.scaled.corners[f];
    if (whole.scaled.points[a].x + whole.scaled.points[b].x + whole.scaled.points[c].x > -0.3) {
      rest.push_back(f);
    }
  }
  whole.part.select(rest);
  whole.valleys.select();
  REQUIRE(whole.part.has_loops());
  segment::ValleyCache marked;
  segment::Valley known = whole.find();
  CHECK(known.length == Approx(length_before));
  const std::vector<segment::Step> steps(known.steps.begin(), known.steps.end());
  const std::vector<double> concavity(known.concavity.begin(), known.concavity.end());
  known = {.steps = steps, .concavity = concavity, .length = 77.0, .greatest = known.greatest, .part = 0};
  marked.store(whole.low, whole.high, known);
  const segment::ValleyLoan loan(whole.valleys, marked);
  CHECK(whole.find().length == Approx(length_before));
  // From a tolerance on by which it is shallow it is taken; from scratch never.
  marked.store(whole.low, whole.high, known);
  CHECK(whole.valleys.find(whole.low, whole.high, 10.0, false).length == 77.0);
  CHECK(whole.valleys.find(whole.low, whole.high, 10.0, true).length == Approx(length_before));
}

}  // namespace ridgecraft
