// SPDX-License-Identifier: GPL-3.0-or-later
// Where no tree was found that folds up with all creases together, the piece is split: for sheets that fold
// themselves.
#pragma once

#include <cstddef>

#include "base/context.hpp"
#include "unfold/patch/patch.hpp"
#include "unfold/patch/room.hpp"

namespace ridgecraft::unfold {

struct LinearSplit {
  Folds folds;
  std::size_t stuck = 0;  ///< pieces that still don't fold together, held by kept edges
};

/// Gives each piece of a clean forest that doesn't fold up with all creases together (fold_order.hpp) a tree
/// that does, whatever that costs in tabs; where none is found the fold goes that lies between the most pairs
/// of faces that meet on the way, among equals the one that leaves the most balanced pieces, and both halves
/// are looked at in the same way. Pieces that fit the room still do. At the deadline nothing is searched any
/// more, but pieces are split all the same. A piece is one task; about 0.05 s for
/// one of 80 faces that has to be split. Deterministic for one seed but for the deadline.
[[nodiscard]] LinearSplit split_to_fold_together(const Patch& patch, const Folds& folds, const Room& room,
                                                 double tolerance, std::uint64_t seed,
                                                 const Context& context);

}  // namespace ridgecraft::unfold
