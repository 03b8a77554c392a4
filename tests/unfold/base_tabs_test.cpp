// SPDX-License-Identifier: GPL-3.0-or-later
// Tabs by which bodies are glued onto others: folded inwards, they stay within the base.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include <catch2/catch.hpp>

#include "base/geometry.hpp"
#include "support/concave_shapes.hpp"
#include "support/flat_panels.hpp"
#include "support/shapes.hpp"
#include "unfold/tabs/place/sites.hpp"
#include "unfold/tabs/shape/convex_shape.hpp"
#include "unfold/tabs_of_nets.hpp"
#include "unfold/tree_nets.hpp"

using namespace ridgecraft;
using test::Sample;
using unfold::Tab;

namespace {

/// An L whose lower arm is 4 mm wide, counterclockwise.
const std::vector<Vec2> l_foot{{0, 0}, {40, 0}, {40, 4}, {20, 4}, {20, 30}, {0, 30}};

/// A sheet of 80 x 80 mm, and over it, `gap` mm higher, walls of 25 mm over the base with a roof; no bottom.
mesh::Surface standing(const std::vector<Vec2>& base, double gap) {
  std::vector<Vec3> points{{-20, -20, 0}, {60, -20, 0}, {60, 60, 0}, {-20, 60, 0}};
  std::vector<std::array<VertexId, 3>> faces{{VertexId(0), VertexId(1), VertexId(2)},
                                             {VertexId(0), VertexId(2), VertexId(3)}};
  const auto count = static_cast<std::uint32_t>(base.size());
  for (const double z : {gap, gap + 25.0}) {
    for (const Vec2 p : base) {
      points.push_back({p.x, p.y, z});
    }
  }
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t next = (i + 1) % count;
    const VertexId a(4 + i);
    const VertexId b(4 + next);
    const VertexId c(4 + count + next);
    const VertexId d(4 + count + i);
    faces.push_back({a, b, c});
    faces.push_back({a, c, d});
  }
  const auto top = [&](std::uint32_t i) { return VertexId(4 + count + i); };
  if (count == 6) {
    for (const auto& [i, j, k] : {std::array{0U, 1U, 2U}, {0U, 2U, 3U}, {0U, 3U, 4U}, {0U, 4U, 5U}}) {
      faces.push_back({top(i), top(j), top(k)});
    }
  }
  return {std::move(points), std::move(faces)};
}

/// It stands askew, so that no side is along an axis.
Vec3 askew(Vec3 p) {
  const Vec3 q{0.8 * p.x - 0.6 * p.y, 0.6 * p.x + 0.8 * p.y, p.z};
  return {q.x, 0.28 * q.y - 0.96 * q.z, 0.96 * q.y + 0.28 * q.z};
}
Vec3 upright(Vec3 p) {
  const Vec3 q{p.x, 0.28 * p.y + 0.96 * p.z, -0.96 * p.y + 0.28 * p.z};
  return {0.8 * q.x + 0.6 * q.y, -0.6 * q.x + 0.8 * q.y, q.z};
}

Sample laid_out(const mesh::Surface& surface) {
  Sample sample{test::mapped(surface, askew), {}, {}};
  sample.panels = test::flat_panels(sample.surface);
  sample.nets = test::lay_out(sample.surface, test::random_order(sample.surface, 5));
  unfold::replace_tabs({sample.surface, sample.panels, {}, {}}, sample.nets, {});
  return sample;
}

/// Corners of a tab that is folded inwards, where the base is.
std::vector<Vec2> folded_inwards(const Sample& sample, const Tab& tab) {
  const mesh::Surface& surface = sample.surface;
  const Vec3 start = upright(surface.point(surface.vertex(mesh::next(tab.side))));
  const Vec3 end = upright(surface.point(surface.vertex(tab.side)));
  const auto& flat = sample.nets.flat[mesh::face_of(tab.side)];
  const Vec2 from = flat[mesh::next(tab.side).value() % 3];
  const Vec2 to = flat[tab.side.value() % 3];
  const Vec2 along = (to - from) / length(to - from);
  const Vec2 ground = Vec2{end.x - start.x, end.y - start.y} / length(end - start);
  std::vector<Vec2> corners;
  for (const Vec2 p : tab.polygon) {
    const double x = dot(p - from, along);
    const double y = dot(p - from, perpendicular(along));
    // Walls run counterclockwise round the base, so backwards along a side its inside is on the right.
    corners.push_back(Vec2{start.x, start.y} + x * ground - y * perpendicular(ground));
  }
  return corners;
}

bool is_within(const std::vector<Vec2>& polygon, Vec2 p) {
  constexpr double hair = 1e-6;
  bool inside = false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 a = polygon[i];
    const Vec2 b = polygon[(i + 1) % polygon.size()];
    const Vec2 d = b - a;
    const double along = std::min(1.0, std::max(0.0, dot(p - a, d) / dot(d, d)));
    if (length(p - a - along * d) <= hair) {
      return true;
    }
    if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / d.y * d.x) {
      inside = !inside;
    }
  }
  return inside;
}

}  // namespace

TEST_CASE("a body that stands on another gets tabs within its base", "[base_tabs]") {
  const Sample sample = laid_out(standing(l_foot, 0.0));
  CHECK(unfold::find_open_bases(sample.surface, {}).size() == 6);
  std::size_t bases = 0;
  for (const TabId t : ids<TabId>(sample.nets.tabs.size())) {
    const Tab& tab = sample.nets.tabs[t];
    if (!tab.of_base) {
      continue;
    }
    ++bases;
    CHECK(unfold::is_additional(sample.nets, t));
    CHECK(sample.nets.use[sample.surface.edge(tab.side)] == unfold::EdgeUse::border);
    const std::vector<Vec2> ground = folded_inwards(sample, tab);
    for (std::size_t i = 0; i < ground.size(); ++i) {
      const Vec2 next = ground[(i + 1) % ground.size()];
      for (const double share : {0.0, 0.25, 0.5, 0.75}) {
        CHECK(is_within(l_foot, ground[i] + share * (next - ground[i])));
      }
    }
    const unfold::ConvexShape shape((std::span<const Vec2>(tab.polygon)));
    const PieceId piece = sample.nets.piece[mesh::face_of(tab.side)];
    for (const FaceId f : sample.nets.pieces[piece].faces) {
      CHECK(unfold::separation(shape, unfold::ConvexShape(std::span<const Vec2>(sample.nets.flat[f]))) >
            -1e-6);
    }
    for (const TabId other : ids<TabId>(sample.nets.tabs.size())) {
      if (other != t && sample.nets.piece[mesh::face_of(sample.nets.tabs[other].side)] == piece) {
        const std::vector<Vec2>& polygon = sample.nets.tabs[other].polygon;
        CHECK(unfold::separation(shape, unfold::ConvexShape(std::span<const Vec2>(polygon))) > -1e-6);
      }
    }
  }
  // All sides but perhaps the end of the narrow arm.
  CHECK(bases >= 5);
}

TEST_CASE("what stands in the air or over an edge has no base", "[base_tabs]") {
  CHECK(unfold::find_open_bases(standing(l_foot, 0.19), {}).size() == 6);
  CHECK(unfold::find_open_bases(standing(l_foot, 0.21), {}).empty());
  std::vector<Vec2> beyond = l_foot;
  for (Vec2& p : beyond) {
    p.x += 45.0;
  }
  CHECK(unfold::find_open_bases(standing(beyond, 0.0), {}).size() < 6);
}

TEST_CASE("no tabs are wanted, none at bases either", "[base_tabs]") {
  Sample sample = laid_out(standing(l_foot, 0.0));
  unfold::Options options;
  options.tabs.wanted = false;
  unfold::replace_tabs({sample.surface, sample.panels, options, {}}, sample.nets, {});
  CHECK(sample.nets.tabs.size() == 0);
}
