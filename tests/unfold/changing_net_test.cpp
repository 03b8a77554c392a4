// SPDX-License-Identifier: GPL-3.0-or-later
// A net and its tabs while its tree changes.
#include "unfold/tabs/trees/changing_net.hpp"

#include <cmath>
#include <numeric>

#include <catch2/catch.hpp>

#include "base/disjoint_sets.hpp"
#include "base/random.hpp"
#include "support/shapes.hpp"
#include "unfold/nets_checks.hpp"
#include "unfold/patch/layout.hpp"
#include "unfold/patch/tree.hpp"
#include "unfold/search/overlap_pairs.hpp"
#include "unfold/search/rooted_net.hpp"
#include "unfold/search/tree_search.hpp"
#include "unfold/tabs/place/assignment.hpp"
#include "unfold/tabs/trees/tabs_of_tree.hpp"
#include "unfold/tree_nets.hpp"

using namespace ridgecraft;
using mesh::Surface;
using prepare::Panels;
using test::tolerance;
using unfold::ConvexShape;
using unfold::Folds;
using unfold::Patch;
using unfold::RootedNet;
using unfold::TabOptions;
using unfold::TabState;
using unfold::TreeSearch;

namespace {

/// A sphere with dents and bumps: 2 * 16 * 9 faces, 120 mm across.
Surface large_lumpy(std::uint64_t seed) {
  const Surface ball = test::sphere(16, 10);
  Random random(seed);
  std::vector<Vec3> points;
  for (const Vec3 p : ball.points()) {
    points.push_back((50.0 + 20.0 * random.unit()) * p);
  }
  std::vector<std::array<VertexId, 3>> faces;
  for (const FaceId f : ids<FaceId>(ball.face_count())) {
    faces.push_back(ball.vertices(f));
  }
  return Surface(std::move(points), std::move(faces));
}

/// A surface as one patch, and a clean net of it.
struct NetExample {
  explicit NetExample(Surface s, std::uint64_t seed)
      : surface(std::move(s)), panels(prepare::find_panels(surface)) {
    patch = test::whole_patch(surface, panels);
    Random random(seed);
    TreeSearch net(patch, tolerance, seed);
    net.set_tree(unfold::start_tree(patch, unfold::StartTree::short_cuts, random));
    REQUIRE(net.run({20000, 20000}, Context()));
    folds = net.folds();
  }
  Surface surface;
  Panels panels;
  Patch patch;
  Folds folds;
};

bool is_spanning_tree(const Patch& patch, const Folds& folds) {
  ridgecraft::DisjointSets sets(patch.size());
  std::uint32_t joined = 0;
  for (std::uint32_t side = 0; side < folds.size(); ++side) {
    if (folds[side] != 0 && side < patch.twin[side]) {
      if (folds[patch.twin[side]] == 0 || !sets.join(side / 3, patch.twin[side] / 3)) {
        return false;
      }
      ++joined;
    }
  }
  return joined + 1 == patch.size();
}

/// All chosen tabs in the plane of the net.
std::vector<std::vector<Vec2>> all_tabs(const Patch& patch, const RootedNet& net, const TabState& state) {
  std::vector<std::vector<Vec2>> tabs;
  for (std::uint32_t side = 0; side < patch.twin.size(); ++side) {
    if (const unfold::TabCandidate* tab = state.tab_on(side)) {
      const Vec2 a = net.flat(side / 3)[(side % 3 + 1) % 3];
      const Vec2 b = net.flat(side / 3)[side % 3];
      const ConvexShape shape(std::span<const Vec2>(tab->whole.corner));
      const ConvexShape placed = unfold::Frame{a, (b - a) / length(b - a)}.out(shape);
      tabs.emplace_back(placed.begin(), placed.end());
    }
  }
  return tabs;
}

/// The tab on each side, if any.
std::vector<const unfold::TabCandidate*> sides_with_tabs(const Patch& patch, const TabState& state) {
  std::vector<const unfold::TabCandidate*> tabs;
  for (std::uint32_t side = 0; side < patch.twin.size(); ++side) {
    tabs.push_back(state.tab_on(side));
  }
  return tabs;
}

/// No tab lies on a face or on another tab, by brute force.
void check_no_collision(const Patch& patch, const RootedNet& net, const TabState& state) {
  const auto tabs = all_tabs(patch, net, state);
  CHECK(tabs.size() == state.tabs());
  for (std::size_t i = 0; i < tabs.size(); ++i) {
    for (std::uint32_t f = 0; f < patch.size(); ++f) {
      CHECK(test::penetration(tabs[i], {net.flat(f).begin(), net.flat(f).end()}) < 1e-6);
    }
    for (std::size_t j = 0; j < i; ++j) {
      CHECK(test::penetration(tabs[i], tabs[j]) < 1e-6);
    }
  }
}

}  // namespace

TEST_CASE("a changing net knows its tabs, its hull and its way back", "[tab_search]") {
  const NetExample example(large_lumpy(7), 7);
  const Patch& patch = example.patch;
  unfold::ChangingNet net(example.surface, example.panels, patch, example.folds, TabOptions(), tolerance);
  unfold::ChangingNet bare(patch, example.folds, tolerance);
  CHECK(bare.tabs() == 0);
  Random random(8);
  int kept = 0;
  for (int trial = 0; trial < 1000 && kept < 40; ++trial) {
    const std::uint32_t side = random.below(static_cast<std::uint32_t>(patch.twin.size()));
    if (!net.tab_state().is_cut(side)) {
      continue;
    }
    const auto swap = unfold::draw_swap_at(side, patch, net.tree(), random);
    REQUIRE(swap);
    if (!net.is_clean(*swap)) {
      continue;
    }
    const Folds before = net.folds();
    const std::uint32_t tabs = net.tabs();
    if (random.below(3) == 0) {
      net.make_with_tabs(*swap);
    } else {
      net.make(*swap);
    }
    CHECK(is_spanning_tree(patch, net.folds()));
    CHECK(net.folds() != before);
    if (random.below(2) == 0) {
      static_cast<void>(net.tabs());
    }
    if (random.below(3) == 0) {
      net.take_back();
      CHECK(net.folds() == before);
      CHECK(net.tabs() == tabs);
      continue;
    }
    net.keep();
    ++kept;
    CHECK(net.is_clean());
    check_no_collision(patch, net.tree(), net.tab_state());
    bare.set_tree(net.folds());
    double area = 0.0;
    const auto hull = net.hull();
    const auto bare_hull = bare.hull();
    for (std::size_t i = 1; i + 1 < hull.size(); ++i) {
      area += cross(hull[i] - hull[0], hull[i + 1] - hull[0]);
    }
    for (std::size_t i = 1; i + 1 < bare_hull.size(); ++i) {
      area -= cross(bare_hull[i] - bare_hull[0], bare_hull[i + 1] - bare_hull[0]);
    }
    CHECK(std::abs(area) < 1e-6);
  }
  CHECK(kept == 40);
  // Set afresh, the tabs depend on the tree alone.
  const Folds last = net.folds();
  net.set_tree(last);
  unfold::ChangingNet other(example.surface, example.panels, patch, last, TabOptions(), tolerance);
  CHECK(net.tabs() == other.tabs());
  net.set_tree(example.folds);
  net.set_tree(last);
  CHECK(net.tabs() == other.tabs());
}

TEST_CASE("tabs that are kept up to date collide with nothing, and changes can be taken back",
          "[tab_search]") {
  const NetExample example(large_lumpy(5), 5);
  const Patch& patch = example.patch;
  RootedNet net(patch);
  unfold::OverlapPairs pairs(net, tolerance);
  net.set_tree(example.folds);
  TabState state(example.surface, example.panels, patch, net, TabOptions());
  state.renew_all();
  check_no_collision(patch, net, state);
  CHECK(state.tabs() > 0);
  Random random(6);
  int swaps = 0;
  for (int trial = 0; trial < 1000 && swaps < 60; ++trial) {
    const std::uint32_t side = random.below(static_cast<std::uint32_t>(patch.twin.size()));
    if (!state.is_cut(side)) {
      continue;
    }
    const auto path = net.removable_between(side / 3, patch.twin[side] / 3);
    const std::uint32_t below = path[random.below(static_cast<std::uint32_t>(path.size()))];
    if (!pairs.after_swap().is_clean(below, side)) {
      continue;
    }
    ++swaps;
    const auto before = all_tabs(patch, net, state);
    const auto sides = sides_with_tabs(patch, state);
    const double held = state.held_mm();
    state.swap(below, side);
    pairs.find_all();
    CHECK(pairs.total() == 0);
    if (swaps % 10 == 0) {
      check_no_collision(patch, net, state);
    }
    if (swaps % 3 == 0) {
      state.take_back();
      CHECK(sides_with_tabs(patch, state) == sides);
      CHECK(state.held_mm() == Approx(held));
      const auto after = all_tabs(patch, net, state);
      REQUIRE(after.size() == before.size());
      // The other part may have moved instead, so shapes are compared by their sides.
      for (std::size_t i = 0; i < after.size(); ++i) {
        CHECK(length(after[i][1] - after[i][0]) == Approx(length(before[i][1] - before[i][0])));
      }
      check_no_collision(patch, net, state);
    }
  }
  CHECK(swaps >= 30);
}
