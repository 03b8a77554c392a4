// SPDX-License-Identifier: GPL-3.0-or-later
// What is tried where the first search finds no net.
#include "unfold/pieces/fewest_pieces.hpp"

#include <catch2/catch.hpp>

#include "bench/spiky_bodies.hpp"
#include "unfold/nets_checks.hpp"
#include "unfold/patch/layout.hpp"
#include "unfold/patch/tree.hpp"
#include "unfold/pieces/page_split.hpp"
#include "unfold/pieces/patch_nets.hpp"
#include "unfold/search/heated_search.hpp"

using namespace ridgecraft;
using namespace ridgecraft::unfold;
using test::tolerance;

namespace {

NetFound best_of_a_moment(const Patch& patch, std::uint64_t iterations) {
  NetSearch search;
  search.tolerance = tolerance;
  search.iterations = iterations;
  return find_net(patch, search, 1, {});
}

}  // namespace

TEST_CASE("spiky bodies have the faces that their names tell", "[spiky]") {
  for (const bench::SpikyBody& body : bench::spiky_family()) {
    CHECK(body.name.ends_with(" " + std::to_string(body.surface.face_count())));
    CHECK(body.surface.component_count() == 1);
    // Closed.
    CHECK(2 * body.surface.edge_count() == 3 * body.surface.face_count());
  }
}

TEST_CASE("spiky bodies become one net with every seed", "[spiky][slow]") {
  for (const bench::SpikyBody& body : bench::spiky_family()) {
    const Patch patch = test::whole_patch(body.surface);
    for (const std::uint64_t seed : {1U, 2U}) {
      const PatchNets nets =
          unfold_patch(patch, {}, PanelCuts::before_pieces, tolerance, seed, Effort::full, {});
      INFO(body.name << ", seed " << seed);
      CHECK(cost_of(patch, nets.folds).pieces == 1);
      CHECK(find_overlaps(lay_out(patch, nets.folds), tolerance).empty());
    }
  }
}

TEST_CASE("heat finds what it counts, and the same for one seed", "[spiky]") {
  const Patch patch = test::whole_patch(bench::spiky_ball(1, 64, 2.5, 3));
  Random random(1);
  const Folds start = start_tree(patch, StartTree::short_cuts, random);
  const HeatedFound brief = heated_search(patch, start, {tolerance, 2000}, 7, {});
  CHECK(brief.trials <= 2000);
  CHECK(find_overlaps(lay_out(patch, brief.folds), tolerance).size() == brief.overlaps);
  CHECK(cost_of(patch, brief.folds).pieces == 1);
  CHECK(heated_search(patch, start, {tolerance, 2000}, 7, {}).folds == brief.folds);
  const HeatedFound found = heated_search(patch, start, {tolerance, heated_trials(patch.size())}, 7, {});
  CHECK(found.overlaps == 0);
  CHECK(found.trials < heated_trials(patch.size()));
}

TEST_CASE("where there is no net for a tree, two that are linked come before many", "[spiky]") {
  // Spikes so long that no single net was ever found.
  const Patch patch = test::whole_patch(bench::spiky_ball(1, 64, 6.0, 1));
  const NetFound failed = best_of_a_moment(patch, 500);
  REQUIRE(failed.overlaps > 0);
  const FewestPieces few = fewest_pieces(patch, failed, tolerance, 1, {});
  CHECK(few.pieces == cost_of(patch, few.folds).pieces);
  CHECK(find_overlaps(lay_out(patch, few.folds), tolerance).empty());
  const std::size_t by_cuts = cost_of(patch, split_overlaps(patch, failed.folds, tolerance)).pieces;
  CHECK(few.pieces <= 7);
  CHECK(2 * few.pieces < by_cuts);
  CHECK(few.proven_least == 1);
}
