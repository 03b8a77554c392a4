// SPDX-License-Identifier: GPL-3.0-or-later
// A forest that changes by moves, and all that is kept up to date with it, against looking at it again.
#include "unfold/energy/forest_search.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include <catch2/catch.hpp>

#include "base/random.hpp"
#include "support/shapes.hpp"
#include "unfold/energy/forest_energy.hpp"
#include "unfold/nets_checks.hpp"
#include "unfold/patch/layout.hpp"
#include "unfold/patch/tree.hpp"
#include "unfold/search/forest.hpp"
#include "unfold/search/forest_overlaps.hpp"
#include "unfold/tabs/trees/tabs_of_tree.hpp"
#include "unfold/tree_nets.hpp"

using namespace ridgecraft;
using test::tolerance;
using unfold::Folds;
using unfold::Forest;
using unfold::Move;
using unfold::Patch;
using unfold::Weights;

namespace {

/// A sphere with dents and bumps; `even`: those of one side are mirrored in the plane y = 0.
mesh::Surface lumpy(std::uint64_t seed, bool even = false) {
  const mesh::Surface ball = test::sphere(12, 7);
  const auto unit_of = [&](Vec3 p) {
    const auto part = [](double x) {
      return static_cast<std::uint64_t>(static_cast<std::int64_t>(std::round(1e6 * x)));
    };
    Random random(seed + 7919 * part(p.x) + 104729 * part(even ? std::abs(p.y) : p.y) + 1299709 * part(p.z));
    return random.unit();
  };
  std::vector<Vec3> points;
  for (const Vec3 p : ball.points()) {
    points.push_back((40.0 + 20.0 * unit_of(p)) * p);
  }
  std::vector<std::array<VertexId, 3>> faces;
  for (const FaceId f : ids<FaceId>(ball.face_count())) {
    faces.push_back(ball.vertices(f));
  }
  return mesh::Surface(std::move(points), std::move(faces));
}

/// A surface as one patch, and a forest of it that may overlap.
struct Example {
  Example(std::uint64_t seed, std::size_t trees, bool even = false)
      : surface(lumpy(seed, even)),
        panels(test::no_panels(surface)),
        patch(test::whole_patch(surface, panels)) {
    Random random(seed);
    folds = unfold::start_tree(patch, random);
    for (std::size_t left = trees - 1; left > 0;) {
      const std::uint32_t side = random.below(static_cast<std::uint32_t>(folds.size()));
      if (folds[side] != 0) {
        unfold::set_fold(patch, folds, side, false);
        --left;
      }
    }
    for (std::uint32_t f = 0; f < patch.size(); ++f) {
      part.push_back(f % 3);
    }
  }

  [[nodiscard]] unfold::ForestProblem problem(const unfold::TabOptions& tabs, const unfold::Room& room,
                                              const Weights& weights) const {
    return {surface, panels, patch, part, tabs, room, weights};
  }

  mesh::Surface surface;
  prepare::Panels panels;
  Patch patch;
  Folds folds;
  std::vector<std::uint32_t> part;
};

/// Any legal move of any kind.
Move draw_move(Forest& forest, Random& random) {
  const Patch& patch = forest.patch();
  for (;;) {
    const auto side = [&](std::uint8_t folded) {
      for (;;) {
        const std::uint32_t s = random.below(static_cast<std::uint32_t>(patch.twin.size()));
        if (forest.folds()[s] == folded) {
          return s;
        }
      }
    };
    const std::uint32_t kind = random.below(4);
    Move move;
    move.opened = kind != 0 ? side(1) : no_index;
    move.closed = kind != 1 ? side(0) : no_index;
    if (forest.is_legal(move)) {
      return move;
    }
  }
}

/// Each tree lies as in a layout of its own, as far as distances can tell.
void check_places(const Forest& forest) {
  const unfold::Layout layout = unfold::lay_out(forest.patch(), forest.folds());
  REQUIRE(layout.faces.size() == forest.trees().size());
  for (const std::uint32_t t : forest.trees()) {
    const std::vector<std::uint32_t>& faces = forest.faces_of(t);
    const std::uint32_t first = faces.front();
    CHECK(faces.size() == layout.faces[layout.piece[first]].size());
    for (std::uint32_t i = 0; i < faces.size(); ++i) {
      const std::uint32_t f = faces[i];
      REQUIRE(layout.piece[f] == layout.piece[first]);
      CHECK(forest.tree_of(f) == t);
      CHECK(forest.position(f) == i);
      for (std::size_t k = 0; k < 3; ++k) {
        for (std::size_t j = 0; j < 2; ++j) {
          CHECK(length(forest.flat(f)[k] - forest.flat(first)[j]) ==
                Approx(length(layout.flat[f][k] - layout.flat[first][j])).margin(1e-7));
        }
      }
    }
  }
}

std::size_t overlaps_by_brute_force(const Forest& forest) {
  return unfold::find_overlaps(unfold::lay_out(forest.patch(), forest.folds()), tolerance).size();
}

}  // namespace

TEST_CASE("a forest lies after its moves as if it were laid out again, and each move has an inverse",
          "[forest]") {
  for (const std::size_t trees : {1U, 2U, 6U}) {
    const Example example(3 + trees, trees);
    Forest forest(example.patch);
    forest.set_folds(example.folds);
    Random random(trees);
    std::set<int> kinds;
    for (int step = 0; step < 200; ++step) {
      const Move move = draw_move(forest, random);
      const Folds before = forest.folds();
      const std::size_t count = forest.trees().size();
      forest.make(move);
      CHECK(forest.trees().size() == count + (move.splits() ? 1 : 0) - (move.joins() ? 1 : 0));
      kinds.insert(move.splits() ? 1 : move.joins() ? 0 : 2);
      if (step % 3 == 0) {
        REQUIRE(forest.is_legal(move.inverse()));
        forest.make(move.inverse());
        CHECK(forest.folds() == before);
      }
      if (step % 10 == 0) {
        check_places(forest);
      }
    }
    CHECK(kinds.size() == 3);
  }
}

TEST_CASE("overlaps of a forest are counted from move to move, and asked before it is made", "[forest]") {
  const Example example(5, 3);
  Forest forest(example.patch);
  forest.set_folds(example.folds);
  unfold::ForestOverlaps overlaps(forest, tolerance);
  overlaps.find_all();
  Random random(9);
  for (int step = 0; step < 150; ++step) {
    const Move move = draw_move(forest, random);
    const auto before = static_cast<std::int64_t>(overlaps.total());
    const std::int64_t added = overlaps.added(move, 1'000'000);
    for (const std::int64_t limit : {added - 1, added, added + 1}) {
      CHECK((overlaps.added(move, limit) >= limit) == (added >= limit));
    }
    overlaps.make(move);
    forest.make(move);
    CHECK(static_cast<std::int64_t>(overlaps.total()) == before + added);
    if (step % 10 == 0) {
      CHECK(overlaps.total() == overlaps_by_brute_force(forest));
    }
  }
}

TEST_CASE("the cost of a forest is kept up to date from move to move", "[forest][energy]") {
  const Example example(7, 4);
  Forest forest(example.patch);
  forest.set_folds(example.folds);
  const unfold::TabState tabs(example.surface, example.panels, example.patch, forest, unfold::TabOptions());
  const unfold::CutFacts facts{tabs.candidates(), tabs.across(), tabs.seams(), 0.5};
  const unfold::Room room{unfold::Sheet{180.0, 250.0}, 5.0, 100};
  unfold::ForestEnergy energy(forest, example.part, facts, room, Weights());
  Random random(11);
  for (int step = 0; step < 200; ++step) {
    const Move move = draw_move(forest, random);
    const double before = energy.total();
    const std::optional<double> change = energy.rate(move, HUGE_VAL);
    REQUIRE(change);
    if (random.below(3) == 0) {
      energy.drop();
      REQUIRE(energy.total() == before);
      continue;
    }
    forest.make(move);
    energy.keep();
    const unfold::ForestEnergy fresh(forest, example.part, facts, room, Weights());
    REQUIRE(energy.total() == Approx(before + *change).margin(1e-4));
    REQUIRE(energy.total() == Approx(fresh.total()).margin(1e-3));
    REQUIRE(energy.total_without_bare() == Approx(fresh.total_without_bare()).margin(1e-3));
  }
}

TEST_CASE("tabs that are kept up to date collide with nothing, and moves can be taken back",
          "[forest][tabs]") {
  const Example example(9, 4);
  const Patch& patch = example.patch;
  Forest forest(patch);
  forest.set_folds(example.folds);
  unfold::TabState state(example.surface, example.panels, patch, forest, unfold::TabOptions());
  state.renew_all();
  CHECK(state.tabs() > 0);
  const auto shapes = [&] {
    std::vector<std::pair<std::uint32_t, std::vector<Vec2>>> tabs;  // with their trees
    for (std::uint32_t side = 0; side < patch.twin.size(); ++side) {
      if (const unfold::TabCandidate* tab = state.tab_on(side)) {
        const Vec2 a = forest.flat(side / 3)[(side % 3 + 1) % 3];
        const Vec2 b = forest.flat(side / 3)[side % 3];
        const unfold::ConvexShape placed = unfold::Frame{a, (b - a) / length(b - a)}.out(
            unfold::ConvexShape(std::span<const Vec2>(tab->whole.corner)));
        tabs.emplace_back(forest.tree_of(side / 3), std::vector<Vec2>(placed.begin(), placed.end()));
      }
    }
    return tabs;
  };
  const auto sides_with_tabs = [&] {
    std::vector<const unfold::TabCandidate*> tabs;
    for (std::uint32_t side = 0; side < patch.twin.size(); ++side) {
      tabs.push_back(state.tab_on(side));
    }
    return tabs;
  };
  const auto check_no_collision = [&] {
    const auto tabs = shapes();
    CHECK(tabs.size() == state.tabs());
    for (std::size_t i = 0; i < tabs.size(); ++i) {
      for (const std::uint32_t f : forest.faces_of(tabs[i].first)) {
        CHECK(test::penetration(tabs[i].second, {forest.flat(f).begin(), forest.flat(f).end()}) < 1e-6);
      }
      for (std::size_t j = 0; j < i; ++j) {
        CHECK((tabs[i].first != tabs[j].first || test::penetration(tabs[i].second, tabs[j].second) < 1e-6));
      }
    }
  };
  const auto cuts_without_tab = [&] {
    double mm = 0.0;
    for (std::uint32_t side = 0; side < patch.twin.size(); ++side) {
      mm += state.join_of(side) == side && state.is_cut(side) && !state.has_tab(side) ? patch.length[side]
                                                                                      : 0.0;
    }
    return mm;
  };
  check_no_collision();
  Random random(13);
  for (int step = 0; step < 120; ++step) {
    const Move move = draw_move(forest, random);
    const auto sides = sides_with_tabs();
    const double bare = state.bare_mm();
    CHECK(bare == Approx(cuts_without_tab()));
    state.make(move);
    if (step % 3 == 0) {
      state.take_back();
      CHECK(sides_with_tabs() == sides);
      CHECK(state.bare_mm() == Approx(bare));
    }
    if (step % 12 == 0) {
      check_no_collision();
    }
  }
}

TEST_CASE("the search finds cheaper forests without overlap, the same for a seed", "[forest][energy]") {
  const unfold::Room room{unfold::Sheet{200.0, 280.0}, 5.0, 120};
  const unfold::TabOptions tabs;
  const Weights weights;
  const Example example(21, 4);
  const unfold::ForestProblem problem = example.problem(tabs, room, weights);
  const unfold::SearchRules rules = unfold::rules_for(300.0, example.patch.size());
  const Folds found = unfold::search_forest(problem, example.folds, rules, 7, Context());
  CHECK(found == unfold::search_forest(problem, example.folds, rules, 7, Context()));
  const unfold::Layout layout = unfold::lay_out(example.patch, found);
  CHECK(unfold::find_overlaps(layout, tolerance).empty());
  CHECK(unfold::all_fit(example.patch, found, room));
  const std::optional<double> cost = unfold::exact_cost(problem, found);
  REQUIRE(cost);
  CHECK(*cost < 0.95 * unfold::exact_cost(problem, example.folds).value_or(HUGE_VAL));
}

TEST_CASE("a forest costs its seams, and those without a tab once more", "[forest][energy][tabs]") {
  const Example example(9, 4);
  const Patch& patch = example.patch;
  const unfold::Room anywhere;
  const unfold::TabOptions tabs;
  Weights weights;
  weights.pieces = weights.parts = weights.small = weights.panels = weights.thin = 0.0;
  weights.compact = weights.outline = weights.slits = weights.mirror = 0.0;
  const unfold::ForestProblem problem = example.problem(tabs, anywhere, weights);
  Folds folds = example.folds;
  Random random(17);
  for (int step = 0; step < 20; ++step) {
    Forest forest(patch);
    forest.set_folds(folds);
    unfold::TabState state(example.surface, example.panels, patch, forest, tabs);
    state.renew_all();
    double mm = 0.0;
    for (std::uint32_t side = 0; side < patch.twin.size(); ++side) {
      if (state.join_of(side) == side && state.is_cut(side)) {
        mm += unfold::seam_price(patch, side, weights) +
              (state.has_tab(side) ? 0.0 : weights.bare * patch.length[side]);
      }
    }
    CHECK(unfold::exact_cost(problem, folds).value() == Approx(mm));
    unfold::set_fold(patch, folds, random.below(static_cast<std::uint32_t>(folds.size())), false);
  }
}

TEST_CASE("a high price of pieces joins them, a high price of outlines splits them", "[forest][energy]") {
  const Example example(23, 4);
  const unfold::Room anywhere;
  const unfold::TabOptions tabs;
  const auto pieces = [&](const Weights& weights) {
    const Folds found = unfold::search_forest(example.problem(tabs, anywhere, weights), example.folds,
                                              unfold::rules_for(500.0, example.patch.size()), 5, Context());
    return unfold::lay_out(example.patch, found).faces.size();
  };
  Weights few;
  few.pieces = 5000.0;
  few.panels = 0.0;
  Weights many;
  many.pieces = 0.0;
  many.small = 0.0;
  many.outline = 2.0;
  CHECK(pieces(few) < 4);
  CHECK(pieces(many) > 6);
}

TEST_CASE("edges that are mirror images are cut together", "[forest][energy]") {
  const Example example(31, 2, true);
  const Patch& patch = example.patch;
  // The mirror image of a side lies between the mirror images of its ends.
  const auto ends = [&](std::uint32_t side) {
    const CornerId c = mesh::corner(patch.face[side / 3], side % 3);
    return std::pair(example.surface.point(example.surface.vertex(c)),
                     example.surface.point(example.surface.vertex(mesh::next(c))));
  };
  std::vector<unfold::SideImages> images(1);
  std::vector<std::uint32_t>& mirror = images.front().side;
  mirror.assign(patch.twin.size(), no_index);
  for (std::uint32_t side = 0; side < patch.twin.size(); ++side) {
    const auto [a, b] = ends(side);
    for (std::uint32_t other = 0; other < patch.twin.size(); ++other) {
      const auto [c, d] = ends(other);
      const auto image = [](Vec3 p) { return Vec3{p.x, -p.y, p.z}; };
      if (length(image(a) - d) < 1e-6 && length(image(b) - c) < 1e-6 && other != side &&
          other != patch.twin[side]) {
        mirror[side] = other;
      }
    }
  }
  const auto uneven = [&](const Folds& folds) {
    double sum = 0.0;
    for (std::uint32_t side = 0; side < patch.twin.size(); ++side) {
      sum += mirror[side] != no_index && folds[side] != folds[mirror[side]] ? patch.length[side] : 0.0;
    }
    return sum;
  };
  const unfold::Room anywhere;
  const unfold::TabOptions tabs;
  const Weights weights;
  unfold::ForestProblem problem = example.problem(tabs, anywhere, weights);
  problem.images = images;
  const Folds found =
      unfold::search_forest(problem, example.folds, unfold::rules_for(800.0, patch.size()), 7, Context());
  CHECK(uneven(found) < 0.4 * uneven(example.folds));
}
