// SPDX-License-Identifier: GPL-3.0-or-later
// Tabs that are put through slits: that both can be cut and put together.
#include "unfold/tabs/place/slot_tabs.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <vector>

#include <catch2/catch.hpp>

#include "base/geometry.hpp"
#include "support/flat_panels.hpp"
#include "support/shapes.hpp"
#include "unfold/net/outline.hpp"
#include "unfold/tabs_checks.hpp"
#include "unfold/tabs_of_nets.hpp"
#include "unfold/tree_nets.hpp"

using namespace ridgecraft;
using mesh::Surface;
using test::Sample;
using unfold::Arrow;
using unfold::arrow_measures;
using unfold::ConvexShape;
using unfold::Nets;
using unfold::Span;
using unfold::Tab;

namespace {

Sample with_slots(const Surface& surface, std::uint64_t seed) {
  Sample sample{surface, test::flat_panels(surface), {}};
  sample.nets = test::lay_out(surface, test::steepest_edge(surface, seed));
  unfold::TabChoice choice;
  choice.sides = unfold::TabSides::slots;
  unfold::replace_tabs({sample.surface, sample.panels, {}, choice}, sample.nets, {});
  return sample;
}

/// Models with long and short edges, concave ones and slight folds among them.
Surface model(int number) {
  switch (number) {
    case 0:
      return test::scaled(test::cube(), 60.0);
    case 1:
      return test::scaled(test::cube(), 100.0);
    case 2:
      return test::scaled(test::tetrahedron(), 70.0);
    case 3:
      return test::scaled(test::voxels({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}), 50.0);
    case 4:
      return test::scaled(test::voxels({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {1, 1, 1}}, 2), 40.0);
    case 5:
      return test::scaled(test::sphere(10, 6), 60.0);
    default:
      return test::scaled(
          test::revolve({{0.0, 0.0}, {30.0, 0.0}, {18.0, 40.0}, {24.0, 60.0}, {0.0, 75.0}}, 9), 1.5);
  }
}
constexpr int model_count = 7;

PieceId piece_of_slit(const Sample& sample, const Tab& tab) {
  return sample.nets.piece[mesh::face_of(sample.surface.twin(tab.side))];
}

struct Line {
  Vec2 a, b;
};

double apart(const Line& s, const Line& t) {
  const Vec2 u = s.b - s.a;
  const Vec2 v = t.b - t.a;
  if (cross(u, t.a - s.a) * cross(u, t.b - s.a) < 0.0 && cross(v, s.a - t.a) * cross(v, s.b - t.a) < 0.0) {
    return 0.0;
  }
  return std::min({distance_to_segment(s.a, t.a, t.b), distance_to_segment(s.b, t.a, t.b),
                   distance_to_segment(t.a, s.a, s.b), distance_to_segment(t.b, s.a, s.b)});
}

/// Cuts and folds of a piece; edges inside flat panels are neither.
std::vector<Line> lines_of(const Sample& sample, PieceId piece) {
  std::vector<Line> lines;
  for (const FaceId f : sample.nets.pieces[piece].faces) {
    for (unsigned k = 0; k < 3; ++k) {
      const CornerId c = mesh::corner(f, k);
      const bool flat = sample.nets.use[sample.surface.edge(c)] == unfold::EdgeUse::fold &&
                        sample.panels.panel[f] == sample.panels.panel[sample.surface.neighbor(c)];
      if (!flat) {
        lines.push_back({sample.nets.flat[f][k], sample.nets.flat[f][(k + 1) % 3]});
      }
    }
  }
  return lines;
}

/// Where a point of a piece's plane is on the model; none beside its faces.
std::optional<Vec3> on_model(const Sample& sample, PieceId piece, Vec2 p) {
  for (const FaceId f : sample.nets.pieces[piece].faces) {
    const auto& [a, b, c] = sample.nets.flat[f];
    const double area = cross(b - a, c - a);
    const double second = cross(p - a, c - a) / area;
    const double third = cross(b - a, p - a) / area;
    if (second > -1e-9 && third > -1e-9 && second + third < 1.0 + 1e-9) {
      const auto [u, v, w] = sample.surface.vertices(f);
      const Vec3 at = sample.surface.point(u);
      return at + second * (sample.surface.point(v) - at) + third * (sample.surface.point(w) - at);
    }
  }
  return std::nullopt;
}

}  // namespace

TEST_CASE("arrows are cut from their ground, and slits lie where they are free", "[tabs][slots]") {
  const double height = arrow_measures.height();
  const double width = GENERATE(6.0, 8.0, 11.0, 30.0, 44.0, 95.0, 260.0);
  const double lean = GENERATE(0.0, 2.0);
  const ConvexShape ground{{0.0, 0.0}, {width, 0.0}, {width - lean, height}, {lean, height}};
  const auto free =
      GENERATE_COPY(std::vector<Span>{{3.0, width - 3.0}}, std::vector<Span>{{0.0, width}},
                    std::vector<Span>{{3.0, 0.4 * width}, {0.45 * width, width - 3.0}}, std::vector<Span>{});
  const std::vector<Arrow> arrows = unfold::arrows_within(ground, free);
  if (free.empty() || width < 7.5) {
    CHECK(arrows.empty());
  }
  double last = -1e9;
  for (const Arrow& arrow : arrows) {
    REQUIRE(arrow.polygon.size() == 8);
    CHECK(doubled_area(arrow.polygon) > 0.0);
    for (const Vec2 p : arrow.polygon) {
      CHECK(unfold::separation(ConvexShape{p, p}, ground) < 1e-6);
      CHECK(p.y >= 0.0);
    }
    const double neck = arrow.polygon[1].x - arrow.polygon[0].x;
    const double slit = arrow.slit.to - arrow.slit.from;
    CHECK(neck >= arrow_measures.narrowest_neck - 1e-9);
    CHECK(neck <= arrow_measures.widest_neck + 1e-9);
    CHECK(slit == Approx(neck + arrow_measures.slit_play));
    CHECK(arrow.polygon[3].x - arrow.polygon[6].x > slit + 2.0);
    CHECK(std::ranges::any_of(free, [&](const Span& stretch) {
      return stretch.from <= arrow.slit.from + 1e-9 && arrow.slit.to <= stretch.to + 1e-9;
    }));
    CHECK(arrow.polygon[6].x > last);
    last = arrow.polygon[3].x;
  }
}

TEST_CASE("a slit lies where its tab comes, inside its piece, away from cuts, folds and other slits",
          "[tabs][slots]") {
  const int number = GENERATE(range(0, model_count));
  const std::uint64_t seed = GENERATE(std::uint64_t{1}, std::uint64_t{2}, std::uint64_t{3});
  const Sample sample = with_slots(model(number), seed);
  INFO("model " << number << ", seed " << seed);
  if (test::faces_overlap(sample.nets)) {
    return;  // folds at random; where faces lie on each other, so do the lines of others
  }
  std::map<PieceId, std::vector<Line>> slits;
  for (const Tab& tab : sample.nets.tabs) {
    if (!tab.slit) {
      continue;
    }
    REQUIRE(tab.polygon.size() == 8);
    const auto& [from, to] = *tab.slit;
    const PieceId piece = piece_of_slit(sample, tab);
    for (const Line& line : lines_of(sample, piece)) {
      CHECK(apart({from, to}, line) >= arrow_measures.slit_from_edge - 1e-6);
    }
    for (const Line& other : slits[piece]) {
      CHECK(apart({from, to}, other) >= 0.5 - 1e-6);
    }
    slits[piece].push_back({from, to});
    // Folded over its edge the neck crosses the slit between its ends.
    const Vec2 base = tab.polygon[1] - tab.polygon[0];
    const CornerId side = tab.side;
    const Vec2 start = sample.nets.flat[mesh::face_of(side)][mesh::next(side).value() % 3];
    const double first = dot(tab.polygon[0] - start, base) / length(base);
    const double play = 0.5 * arrow_measures.slit_play;
    const Vec3 one = test::glued(sample.surface, side, first - play, arrow_measures.slit_from_edge);
    const Vec3 two =
        test::glued(sample.surface, side, first + length(base) + play, arrow_measures.slit_from_edge);
    const auto end = on_model(sample, piece, from);
    const auto other_end = on_model(sample, piece, to);
    REQUIRE(end);
    REQUIRE(other_end);
    CHECK(std::min(length(*end - one) + length(*other_end - two),
                   length(*end - two) + length(*other_end - one)) < 1e-6);
  }
  // Each is cut, once, and outlines have the arrows in them.
  for (const PieceId piece : ids<PieceId>(sample.nets.pieces.size())) {
    const unfold::CutLines cuts = unfold::cut_lines(sample.surface, sample.nets, piece);
    for (const Line& slit : slits[piece]) {
      CHECK(std::ranges::count(cuts.slits, std::vector<Vec2>{slit.a, slit.b}) == 1);
    }
    double area = 0.0;
    for (const auto& loop : unfold::outline(sample.surface, sample.nets, piece)) {
      area += doubled_area(loop);
    }
    for (const FaceId f : sample.nets.pieces[piece].faces) {
      area -= doubled_area(sample.nets.flat[f]);
    }
    for (const Tab& tab : sample.nets.tabs) {
      area -= sample.nets.piece[mesh::face_of(tab.side)] == piece ? doubled_area(tab.polygon) : 0.0;
    }
    CHECK(area == Approx(0.0).margin(1e-6));
  }
}

TEST_CASE("arrows go into large faces, and joins without room for a slit keep their glue tab",
          "[tabs][slots]") {
  const Sample cube = with_slots(model(0), 1);
  for (const unfold::Join& join : cube.nets.joins) {
    REQUIRE(join.tab.valid());
    CHECK(cube.nets.tabs[join.tab].slit);
  }
  // Edges of 60 mm have two.
  CHECK(cube.nets.tabs.size() == 2 * cube.nets.joins.size());
  const Sample small = with_slots(test::scaled(test::cube(), 9.0), 1);
  for (const Tab& tab : small.nets.tabs) {
    CHECK_FALSE(tab.slit);
  }
  Nets glued = small.nets;
  unfold::replace_tabs({small.surface, small.panels, {}}, glued, {});
  REQUIRE(glued.tabs.size() == small.nets.tabs.size());
  for (const TabId t : ids<TabId>(glued.tabs.size())) {
    CHECK(glued.tabs[t].polygon == small.nets.tabs[t].polygon);
  }
}

TEST_CASE("nothing else lies where an arrow lies", "[tabs][slots]") {
  const Sample sample = with_slots(model(GENERATE(range(0, model_count))), 2);
  const auto hull = [&](const Tab& tab) {
    const CornerId side = tab.side;
    const Vec2 start = sample.nets.flat[mesh::face_of(side)][mesh::next(side).value() % 3];
    const Vec2 along = sample.nets.flat[mesh::face_of(side)][side.value() % 3] - start;
    const CornerId twin = sample.surface.twin(side);
    const auto& flat = sample.nets.flat[mesh::face_of(twin)];
    const Vec2 to = flat[twin.value() % 3];
    const Vec2 there = flat[mesh::next(twin).value() % 3] - to;
    std::vector<Line> lines;
    const auto place = [&](Vec2 p) {
      const double x = dot(p - start, along) / length(along);
      const double y = cross(along, p - start) / length(along);
      return to + (x / length(there)) * there + (y / length(there)) * perpendicular(there);
    };
    for (std::size_t i = 0; i < tab.polygon.size(); ++i) {
      lines.push_back({place(tab.polygon[i]), place(tab.polygon[(i + 1) % tab.polygon.size()])});
    }
    return lines;
  };
  const auto panel = [&](const Tab& tab) {
    return sample.panels.panel[mesh::face_of(sample.surface.twin(tab.side))];
  };
  for (const TabId t : ids<TabId>(sample.nets.tabs.size())) {
    for (const TabId u : ids<TabId>(sample.nets.tabs.size())) {
      const Tab& one = sample.nets.tabs[t];
      const Tab& other = sample.nets.tabs[u];
      if (t == u || !one.slit || panel(one) != panel(other) ||
          piece_of_slit(sample, one) != piece_of_slit(sample, other)) {
        continue;
      }
      for (const Line& s : hull(one)) {
        for (const Line& r : hull(other)) {
          CHECK(apart(s, r) > 0.4);
        }
      }
    }
  }
}
