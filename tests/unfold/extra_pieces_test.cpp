// SPDX-License-Identifier: GPL-3.0-or-later
// What a step cut off is the reason for one piece, wherever its faces went since.
#include <algorithm>
#include <array>

#include <catch2/catch.hpp>

#include "base/random.hpp"
#include "support/shapes.hpp"
#include "unfold/nets_checks.hpp"
#include "unfold/nets_of_folds.hpp"
#include "unfold/patch/tree.hpp"

using namespace ridgecraft;
using namespace ridgecraft::unfold;

namespace {

/// All folds of a tree but three, drawn at random.
Folds four_trees(const Patch& patch, Random& random) {
  Folds folds = start_tree(patch, StartTree::breadth_first, random);
  for (int cuts = 0; cuts < 3;) {
    const std::uint32_t side = random.below(static_cast<std::uint32_t>(folds.size()));
    if (folds[side] != 0) {
      set_fold(patch, folds, side, false);
      ++cuts;
    }
  }
  return folds;
}

}  // namespace

TEST_CASE("no reason is told more often than there were pieces cut off for it", "[reasons]") {
  const mesh::Surface s = test::scaled(test::sphere(10, 6), 40.0);
  const prepare::Panels panels = test::no_panels(s);
  const IdVector<FaceId, PartId> part = test::one_part(s);
  std::vector<FaceId> faces;
  for (const FaceId f : ids<FaceId>(s.face_count())) {
    faces.push_back(f);
  }
  const Patch patch = make_patch(s, panels, faces);
  Random random(5);
  for (int run = 0; run < 40; ++run) {
    // Three were cut off once; where their faces lie now is chance: the pieces are other ones.
    Causes causes(patch.size());
    const std::array reasons{PieceReason::page, PieceReason::overlap, PieceReason::faces};
    for (std::uint32_t piece = 0; piece < 3; ++piece) {
      for (int i = 0; i < 25; ++i) {
        causes[random.below(patch.size())] = {reasons[piece], piece};
      }
    }
    const Folds folds = four_trees(patch, random);
    const Nets nets = nets_of_folds(s, part, patch, folds, causes);
    REQUIRE(nets.pieces.size() == 4);
    for (const PieceReason reason :
         {PieceReason::part, PieceReason::page, PieceReason::overlap, PieceReason::faces}) {
      CHECK(std::count_if(nets.pieces.begin(), nets.pieces.end(),
                          [&](const Piece& piece) { return piece.reason == reason; }) == 1);
    }
  }
}

TEST_CASE("where more pieces are left than were cut off each tells a reason of its part", "[reasons]") {
  const mesh::Surface s = test::scaled(test::sphere(10, 6), 40.0);
  std::vector<FaceId> faces;
  for (const FaceId f : ids<FaceId>(s.face_count())) {
    faces.push_back(f);
  }
  const Patch patch = make_patch(s, test::no_panels(s), faces);
  Random random(6);
  for (int run = 0; run < 40; ++run) {
    // One cause for some faces, and three pieces more than the part.
    Causes causes(patch.size());
    for (std::uint32_t f = 0; f < patch.size(); f += 1 + random.below(40)) {
      causes[f] = {PieceReason::overlap, 0};
    }
    const Folds folds = four_trees(patch, random);
    const Nets nets = nets_of_folds(s, test::one_part(s), patch, folds, causes);
    REQUIRE(nets.pieces.size() == 4);
    for (std::size_t i = 1; i < nets.pieces.size(); ++i) {
      CHECK(nets.pieces[PieceId(i)].reason == PieceReason::overlap);
    }
    CHECK(nets.pieces[PieceId(0)].reason == PieceReason::part);
  }
}
