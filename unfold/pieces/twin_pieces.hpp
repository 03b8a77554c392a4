// SPDX-License-Identifier: GPL-3.0-or-later
// Pieces of one body that are equal, such as the legs of a chair, get one net.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "base/context.hpp"
#include "mesh/model/surface.hpp"
#include "unfold/patch/patch.hpp"
#include "unfold/patch/problem.hpp"

namespace ridgecraft::unfold {

/// A piece whose faces lie like those of the first of its kind.
struct TwinPiece {
  std::vector<std::uint32_t> faces;              ///< of the whole patch, ascending
  std::vector<std::pair<EdgeId, EdgeId>> edges;  ///< of the first of its kind here, and of this one
};

/// Kinds of two or more pieces.
using TwinPieces = std::vector<std::vector<TwinPiece>>;

/// Pieces of a forest that are equal but for a motion, within what can be seen on paper, and whose labels
/// meet at the same edges; but for such as have no fold that could be elsewhere. O(n log n).
[[nodiscard]] TwinPieces find_twin_pieces(const mesh::Surface& surface, const Patch& patch,
                                          const Folds& folds, const Context& context);

/// The patch with borders around all twins that there are three or more of: they keep their faces, or
/// they were equal no more. O(n).
[[nodiscard]] Patch with_twins_apart(const Patch& patch, const Folds& folds, const TwinPieces& twins);

/// The tree that costs least (energy/piece_cost.hpp) of those that twins have for all of a kind, where it is
/// clean and fits the room. O(n log n).
[[nodiscard]] Folds with_equal_twins(const NetProblem& problem, const Folds& folds, const TwinPieces& twins);

}  // namespace ridgecraft::unfold
