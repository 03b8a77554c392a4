// SPDX-License-Identifier: GPL-3.0-or-later
// What a piece costs its maker: the terms of piece_rules.hpp, measured.
#pragma once

#include <cstddef>

#include "unfold/piece_rules.hpp"
#include "unfold/search/patch.hpp"

namespace ridgecraft::unfold {

/// The cost of one piece: the sum of its terms, each times its weight. `tree`: its folds; `parts`: of how
/// many parts it has faces. O(n log n).
[[nodiscard]] double cost_of_piece(const Patch& piece, const Folds& tree, std::size_t parts,
                                   const Weights& weights);

/// What a piece of these faces costs at least, whatever its tree is.
[[nodiscard]] double least_cost_of_piece(const Patch& piece, std::size_t parts, const Weights& weights);

}  // namespace ridgecraft::unfold
