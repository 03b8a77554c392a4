// SPDX-License-Identifier: GPL-3.0-or-later
// Pieces that are hard to cut out or to fold become two.
#include "unfold/pieces/ragged_pieces.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include <catch2/catch.hpp>

#include "base/random.hpp"
#include "support/shapes.hpp"
#include "unfold/bent_sheets.hpp"
#include "unfold/energy/bands.hpp"
#include "unfold/energy/piece_cost.hpp"
#include "unfold/nets_checks.hpp"
#include "unfold/patch/layout.hpp"
#include "unfold/patch/patch.hpp"
#include "unfold/patch/tree.hpp"

using namespace ridgecraft;
using unfold::Folds;
using unfold::Patch;
using unfold::Weights;

namespace {

/// What all pieces of a forest cost.
double cost_of(const Patch& patch, const Folds& folds, const Weights& weights) {
  double sum = 0.0;
  for (std::vector<std::uint32_t>& faces : unfold::lay_out(patch, folds).faces) {
    std::sort(faces.begin(), faces.end());
    sum += cost_of_piece(sub_patch(patch, faces), sub_folds(patch, folds, faces), unfold::one_part, weights);
  }
  return sum;
}

/// The least that one more cut leads to, by trying each but those across walls that go round.
double least_after_one_cut(const Patch& patch, const Folds& folds, const Weights& weights) {
  const unfold::Bands bands = unfold::find_bands(patch);
  double least = std::numeric_limits<double>::infinity();
  for (std::uint32_t side = 0; side < folds.size(); ++side) {
    if (folds[side] != 0 && side < patch.twin[side] && bands.band[side] == unfold::nothing) {
      Folds cut = folds;
      set_fold(patch, cut, side, false);
      least = std::min(least, cost_of(patch, cut, weights));
    }
  }
  return least;
}

/// A tree that nobody chose: each face hangs on any that hangs already.
Folds any_tree(const Patch& patch, Random& random) {
  Folds folds(patch.twin.size(), 0);
  std::vector<bool> in(patch.size(), false);
  in[random.below(static_cast<std::uint32_t>(patch.size()))] = true;
  for (std::size_t left = patch.size() - 1; left > 0;) {
    const std::uint32_t side = random.below(static_cast<std::uint32_t>(patch.twin.size()));
    const std::uint32_t twin = patch.twin[side];
    if (twin != unfold::nothing && in[side / 3] && !in[twin / 3]) {
      set_fold(patch, folds, side, true);
      in[twin / 3] = true;
      --left;
    }
  }
  return folds;
}

}  // namespace

TEST_CASE("a piece is cut where two cost less, and only there", "[pieces]") {
  Random random(4);
  std::size_t cuts = 0;
  for (int round = 0; round < 30; ++round) {
    const mesh::Surface ball = test::scaled(test::sphere(6 + round % 3, 4), 30.0 + 60.0 * random.unit());
    const Patch patch = test::whole_patch(ball);
    const Folds tree = any_tree(patch, random);
    Weights weights;
    weights.pieces = 100.0 + 400.0 * random.unit();
    const IdVector<FaceId, PartId> part = test::one_part(ball);
    const Folds cut = with_ragged_pieces_cut(patch, part.items(), tree, weights, Context());
    const double before = cost_of(patch, tree, weights);
    const double after = cost_of(patch, cut, weights);
    for (std::size_t side = 0; side < cut.size(); ++side) {
      CHECK(cut[side] <= tree[side]);
    }
    const std::size_t pieces = unfold::lay_out(patch, cut).faces.size();
    cuts += pieces - 1;
    if (pieces == 1) {
      // The folds that promise most are measured, so a little may be missed.
      CHECK(least_after_one_cut(patch, tree, weights) >= 0.97 * before);
    } else {
      CHECK(after < before);
    }
    // By what it costs there is no more to be won than by what promised little.
    CHECK(least_after_one_cut(patch, cut, weights) >= 0.97 * after);
  }
  CHECK(cuts > 20);
}

TEST_CASE("flat regions aren't cut, however ragged", "[pieces]") {
  const mesh::Surface ball = test::scaled(test::sphere(8, 5), 200.0);
  Patch patch = test::whole_patch(ball);
  Random random(7);
  const Folds tree = any_tree(patch, random);
  std::fill(patch.frozen.begin(), patch.frozen.end(), unfold::frozen_in_panel);
  const IdVector<FaceId, PartId> part = test::one_part(ball);
  CHECK(with_ragged_pieces_cut(patch, part.items(), tree, Weights(), Context()) == tree);
}
