// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/pieces/piece_reasons.hpp"

#include <algorithm>
#include <numeric>

#include "unfold/patch/layout.hpp"
#include "unfold/pieces/merge_pieces.hpp"
#include "unfold/pieces/page_split.hpp"

namespace ridgecraft::unfold {
namespace {

/// Pairs of faces that joining what was split may compare: about 0.1 s.
constexpr std::uint64_t joining_pairs = 4'000'000;

}  // namespace

std::size_t pieces_without_paper(const Patch& patch, const Folds& clean, const Room& room, double tolerance,
                                 Random random, const Context& context) {
  const Room any_paper{{}, room.strip, room.max_panels};
  if (all_fit(patch, clean, any_paper)) {
    return cost_of(patch, clean).pieces;
  }
  const Folds split = split_to_fit(patch, clean, any_paper, random, context);
  return cost_of(patch, merge_pieces(patch, split, any_paper, tolerance, joining_pairs, context)).pieces;
}

std::vector<PieceReason> piece_reasons(const Patch& patch, const Folds& folds, const PiecesWithout& without) {
  const Layout layout = lay_out(patch, folds);
  std::vector<std::size_t> by_size(layout.faces.size());
  std::iota(by_size.begin(), by_size.end(), std::size_t{0});
  std::stable_sort(by_size.begin(), by_size.end(), [&](std::size_t a, std::size_t b) {
    return layout.faces[a].size() > layout.faces[b].size();
  });
  std::vector<PieceReason> reason(layout.faces.size(), PieceReason::part);
  for (std::size_t i = 1; i < by_size.size(); ++i) {
    reason[by_size[i]] = i < without.limits  ? without.overlap
                         : i < without.paper ? PieceReason::faces
                                             : PieceReason::page;
  }
  return reason;
}

}  // namespace ridgecraft::unfold
