// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/linear_folding.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "unfold/net/tolerance.hpp"
#include "unfold/nets_of_folds.hpp"
#include "unfold/pieces/linear_split.hpp"

namespace ridgecraft::unfold {

LinearFolding fold_together(const Plan& plan, const Patch& patch, const Folds& folds, Causes causes,
                            const Context& context) {
  LinearSplit split =
      split_to_fold_together(patch, folds, plan.room, net_tolerance(patch.extent), context.seed, context);
  LinearFolding result{std::move(split.folds), std::move(causes)};
  result.split_pieces = blame(patch, folds, result.folds, PieceReason::folding, result.causes);
  return result;
}

void note_linear_folding(std::size_t split_pieces, Nets& nets) {
  nets.notes.push_back((split_pieces == 0   ? std::string("no piece had to be")
                        : split_pieces == 1 ? std::string("1 piece was")
                                            : std::to_string(split_pieces) + " pieces were") +
                       " split off so that all fold up with all creases together");
  const auto others = std::count_if(nets.pieces.begin(), nets.pieces.end(), [](const Piece& piece) {
    return piece.folding.way != FoldWay::together;
  });
  if (others > 0) {
    nets.notes.push_back(std::to_string(others) + (others == 1 ? " piece doesn't" : " pieces don't") +
                         " fold up with all creases together all the same: edges that were to be kept are in "
                         "the way of splitting further");
  }
}

}  // namespace ridgecraft::unfold
