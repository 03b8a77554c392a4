// SPDX-License-Identifier: GPL-3.0-or-later
// Tabs by choice: on which side of a cut, how high, second ones and such at borders.
#include "unfold/tabs/place/tab_requests.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "base/error.hpp"
#include "support/flat_panels.hpp"
#include "support/shapes.hpp"
#include "unfold/tabs/place/more_tabs.hpp"
#include "unfold/tabs/shape/convex_shape.hpp"
#include "unfold/tabs_checks.hpp"
#include "unfold/tabs_of_nets.hpp"
#include "unfold/tree_nets.hpp"

using namespace ridgecraft;
using mesh::Surface;
using test::Sample;
using unfold::Nets;
using unfold::TabChoice;
using unfold::TabSides;

namespace {

/// A box with many small faces along its seams.
Sample box() {
  Sample sample{test::scaled(test::voxels({{0, 0, 0}, {1, 0, 0}}, 3), 45.0), {}, {}};
  sample.panels = test::flat_panels(sample.surface);
  sample.nets = test::lay_out(sample.surface, test::random_order(sample.surface, 3));
  return sample;
}

Nets chosen(const Sample& sample, const TabChoice& choice) {
  Nets nets = sample.nets;
  unfold::replace_tabs({sample.surface, sample.panels, {}, choice}, nets, {});
  return nets;
}

TabChoice with_edge(const unfold::EdgeTab& edge) {
  TabChoice choice;
  choice.edges = {edge};
  return choice;
}

TabChoice with_sides(TabSides sides) {
  TabChoice choice;
  choice.sides = sides;
  return choice;
}

TabChoice with_borders() {
  TabChoice choice;
  choice.borders = true;
  return choice;
}

Surface stretched(const Surface& surface, Vec3 factors) {
  std::vector<Vec3> points;
  for (const VertexId v : ids<VertexId>(surface.vertex_count())) {
    const Vec3 p = surface.point(v);
    points.push_back({factors.x * p.x, factors.y * p.y, factors.z * p.z});
  }
  std::vector<std::array<VertexId, 3>> faces;
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    faces.push_back(surface.vertices(f));
  }
  return Surface(points, faces);
}

double height_of(const unfold::Tab& tab) {
  const Vec2 base = tab.polygon[1] - tab.polygon[0];
  double height = 0.0;
  for (const Vec2 p : tab.polygon) {
    height = std::max(height, std::abs(cross(base, p - tab.polygon[0])) / length(base));
  }
  return height;
}

std::size_t count_tabs(const Nets& nets) {
  return static_cast<std::size_t>(std::count_if(nets.joins.begin(), nets.joins.end(),
                                                [](const unfold::Join& join) { return join.tab.valid(); }));
}

}  // namespace

TEST_CASE("without a choice tabs are as they were", "[tab_requests]") {
  const Sample sample = box();
  const Nets plain = chosen(sample, {});
  CHECK(count_tabs(plain) > plain.joins.size() / 3);
  for (const TabId tab : ids<TabId>(plain.tabs.size())) {
    CHECK_FALSE(unfold::is_additional(plain, tab));
  }
}

TEST_CASE("heights follow the length of the edge", "[tab_requests]") {
  const Sample sample = box();
  TabChoice choice;
  choice.heights_mm = {{0.0, 3.0}, {14.0, 4.0}};
  const Nets nets = chosen(sample, choice);
  std::size_t full = 0;
  for (const unfold::Tab& tab : nets.tabs) {
    const double edge = sample.surface.length(sample.surface.edge(tab.side));
    const double asked = edge >= 14.0 ? 4.0 : 3.0;
    CHECK(height_of(tab) <= asked + 1e-9);
    full += height_of(tab) > asked - 1e-6 ? 1U : 0U;
  }
  CHECK(full > nets.tabs.size() / 2);
}

TEST_CASE("what is asked of an edge by its number is done", "[tab_requests]") {
  const Sample sample = box();
  const Nets plain = chosen(sample, {});
  const auto with_tab = std::find_if(plain.joins.begin(), plain.joins.end(),
                                     [](const unfold::Join& join) { return join.tab.valid(); });
  REQUIRE(with_tab != plain.joins.end());
  unfold::EdgeTab asked;
  asked.number = with_tab->number;
  asked.where = "tabs.txt, line 1";
  asked.wanted = false;
  const Nets without = chosen(sample, with_edge(asked));
  for (const unfold::Join& join : without.joins) {
    CHECK(join.tab.valid() == (join.number != asked.number && join.tab.valid()));
    if (join.number == asked.number) {
      CHECK(join.no_tab == unfold::NoTab::not_wanted);
    }
  }
  asked.number = 9999;
  CHECK_THROWS_WITH(chosen(sample, with_edge(asked)),
                    Catch::Contains("tabs.txt, line 1") && Catch::Contains("9999"));
  asked.number = with_tab->number;
  asked.wanted = true;
  asked.piece = "ZZZ";
  CHECK_THROWS_AS(chosen(sample, with_edge(asked)), Error);
}

TEST_CASE("of what is asked of an edge several times the last counts alone", "[tab_requests]") {
  const Sample sample = box();
  const Nets plain = chosen(sample, {});
  unfold::EdgeTab first;
  first.number = plain.joins[JoinId(0)].number;
  first.where = "tabs.txt, line 1";
  first.both = true;
  first.height_mm = 2.0;
  unfold::EdgeTab last;
  last.number = first.number;
  last.where = "tabs.txt, line 2";
  last.angle = 1.0;
  TabChoice choice;
  choice.edges = {first, last};
  const std::vector<unfold::TabRequest> requests = unfold::tab_requests(sample.surface, plain, {}, choice);
  CHECK_FALSE(requests[0].second);
  CHECK(requests[0].options.height_mm == 5.0);
  CHECK(requests[0].options.angle == 1.0);
}

TEST_CASE("what is asked of an edge is kept where pieces are equal", "[tab_requests]") {
  // Six squares: their tabs are made alike where nobody asks for another.
  Sample sample{test::scaled(test::cube(), 40.0), {}, {}};
  sample.panels = test::flat_panels(sample.surface);
  std::vector<EdgeId> cuts;
  for (const EdgeId edge : ids<EdgeId>(sample.surface.edge_count())) {
    if (std::abs(sample.surface.fold_angle(edge)) > 0.1) {
      cuts.push_back(edge);
    }
  }
  sample.nets = test::lay_out(sample.surface, test::panels_first(sample.surface), cuts);
  REQUIRE(sample.nets.pieces.size() == 6);
  REQUIRE(chosen(sample, {}).tabs.size() == 12);
  for (std::uint32_t number = 1; number <= 12; ++number) {
    unfold::EdgeTab asked;
    asked.number = number;
    asked.where = "tabs.txt, line 1";
    asked.height_mm = 2.0;
    const Nets nets = chosen(sample, with_edge(asked));
    REQUIRE(nets.tabs.size() == 12);
    for (const unfold::Tab& tab : nets.tabs) {
      CHECK(height_of(tab) == Approx(nets.joins[tab.join].number == number ? 2.0 : 5.0));
    }
  }
}

TEST_CASE("second tabs stand on the other side, clear of all others", "[tab_requests]") {
  const Sample sample = box();
  const Nets nets = chosen(sample, with_sides(TabSides::both));
  std::size_t seconds = 0;
  for (const TabId tab : ids<TabId>(nets.tabs.size())) {
    if (!unfold::is_additional(nets, tab)) {
      continue;
    }
    ++seconds;
    const unfold::Join& join = nets.joins[nets.tabs[tab].join];
    CHECK(sample.surface.twin(nets.tabs[join.tab].side) == nets.tabs[tab].side);
  }
  CHECK(seconds > count_tabs(nets) / 3);
  const auto polygon = [&](const unfold::Tab& tab) {
    return unfold::ConvexShape(std::span<const Vec2>(tab.polygon));
  };
  for (const TabId a : ids<TabId>(nets.tabs.size())) {
    for (const TabId b : ids<TabId>(nets.tabs.size())) {
      const bool same_piece =
          nets.piece[mesh::face_of(nets.tabs[a].side)] == nets.piece[mesh::face_of(nets.tabs[b].side)];
      if (a < b && same_piece) {
        CHECK(unfold::separation(polygon(nets.tabs[a]), polygon(nets.tabs[b])) > -1e-6);
      }
    }
  }
}

TEST_CASE("second tabs that are higher than others overlap nothing", "[tab_requests]") {
  // A U with arms of 9 mm and 4.5 mm between them: within its front there is no room for a high tab.
  std::vector<std::array<int, 3>> cubes;
  for (int x = 0; x < 5; ++x) {
    for (int y = 0; y < 3; ++y) {
      if (x != 2 || y == 0) {
        cubes.push_back({x, y, 0});
      }
    }
  }
  const Surface letter = stretched(test::voxels(cubes), {4.5, 18.0, 18.0});
  std::vector<EdgeId> cuts;
  for (const EdgeId edge : ids<EdgeId>(letter.edge_count())) {
    if (std::abs(letter.fold_angle(edge)) > 0.1) {
      cuts.push_back(edge);
    }
  }
  Nets nets = test::lay_out(letter, test::panels_first(letter), cuts);
  TabChoice choice = with_sides(TabSides::both);
  choice.heights_mm = {{0.0, 3.0}, {14.0, 8.0}};
  choice.angles = {{0.0, std::numbers::pi / 2}};
  unfold::Options options;
  options.tabs.height_mm = 3.0;
  unfold::replace_tabs({letter, test::flat_panels(letter), options, choice}, nets, {});
  std::size_t high = 0;
  for (const TabId t : ids<TabId>(nets.tabs.size())) {
    high += unfold::is_additional(nets, t) && height_of(nets.tabs[t]) > 3.1 ? 1U : 0U;
    const unfold::ConvexShape tab(std::span<const Vec2>(nets.tabs[t].polygon));
    for (const FaceId f : nets.pieces[nets.piece[mesh::face_of(nets.tabs[t].side)]].faces) {
      CHECK(unfold::separation(tab, unfold::ConvexShape(std::span<const Vec2>(nets.flat[f]))) > -1e-6);
    }
  }
  CHECK(high > 0);
}

TEST_CASE("tabs at borders follow the length of the edge, too", "[tab_requests]") {
  Sample sample{test::scaled(test::revolve({{1.0, 0.0}, {1.0, 1.0}}, 6), 30.0), {}, {}};
  sample.panels = test::flat_panels(sample.surface);
  sample.nets = test::lay_out(sample.surface, test::random_order(sample.surface, 1));
  TabChoice choice = with_borders();
  choice.heights_mm = {{0.0, 3.0}, {14.0, 8.0}};
  const Nets nets = chosen(sample, choice);
  std::size_t full = 0;
  for (const unfold::Tab& tab : nets.tabs) {
    full += !tab.join.valid() && std::abs(height_of(tab) - 8.0) < 1e-6 ? 1U : 0U;
  }
  CHECK(full >= 6);
}

TEST_CASE("borders get tabs where they are wanted", "[tab_requests]") {
  Sample sample{test::scaled(test::revolve({{1.0, 0.0}, {1.0, 1.0}}, 6), 30.0), {}, {}};
  sample.panels = test::flat_panels(sample.surface);
  sample.nets = test::lay_out(sample.surface, test::random_order(sample.surface, 1));
  CHECK(chosen(sample, {}).tabs.size() <= sample.nets.joins.size());
  const Nets nets = chosen(sample, with_borders());
  std::size_t at_borders = 0;
  for (const unfold::Tab& tab : nets.tabs) {
    at_borders += tab.join.valid() ? 0U : 1U;
    CHECK(tab.join.valid() == (nets.use[sample.surface.edge(tab.side)] != unfold::EdgeUse::border));
  }
  CHECK(at_borders >= 6);
}

TEST_CASE("along a seam tabs keep to a side, or alternate", "[tab_requests]") {
  Sample sample = box();
  std::vector<EdgeId> middle;  // between the two cubes
  for (const EdgeId edge : ids<EdgeId>(sample.surface.edge_count())) {
    const CornerId side = sample.surface.sides(edge)[0];
    const auto at_middle = [&](CornerId c) {
      return std::abs(sample.surface.point(sample.surface.vertex(c)).x - 45.0) < 1e-9;
    };
    if (at_middle(side) && at_middle(mesh::next(side))) {
      middle.push_back(edge);
    }
  }
  sample.nets = test::lay_out(sample.surface, test::panels_first(sample.surface), middle);
  REQUIRE(sample.nets.pieces.size() == 2);
  const auto changes = [&](TabSides sides) {
    const Nets nets = chosen(sample, with_sides(sides));
    std::map<std::pair<PieceId, PieceId>, std::vector<PieceId>> givers;
    for (const unfold::Join& join : nets.joins) {
      if (join.tab.valid()) {
        const auto [c, d] = sample.surface.sides(join.edge);
        const PieceId one = nets.piece[mesh::face_of(c)];
        const PieceId other = nets.piece[mesh::face_of(d)];
        if (one != other) {
          givers[std::minmax(one, other)].push_back(nets.piece[mesh::face_of(nets.tabs[join.tab].side)]);
        }
      }
    }
    std::size_t changed = 0;
    for (const auto& [seam, list] : givers) {
      for (std::size_t i = 1; i < list.size(); ++i) {
        changed += list[i] != list[i - 1] ? 1U : 0U;
      }
    }
    return changed;
  };
  CHECK(middle.size() == 12);
  CHECK(changes(TabSides::one_side) == 0);
  CHECK(changes(TabSides::alternate) >= 8);
}
