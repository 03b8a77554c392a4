// SPDX-License-Identifier: GPL-3.0-or-later
// What makes a set of pieces easy to build: terms with names and weights.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "unfold/patch.hpp"
#include "unfold/unfold.hpp"

namespace ridgecraft::unfold {

/// A term's weight by its name ("cut", "pieces", "parts", "compact", "thin", "small", "panels"); null where
/// there is no such term.
[[nodiscard]] double* weight_named(Weights& weights, std::string_view name);

/// The names of all terms, in the order of Weights.
[[nodiscard]] std::span<const std::string_view> term_names();

/// The cost of one piece: the sum of its terms, each times its weight. `tree`: its folds; `parts`: of how
/// many parts it has faces. O(n log n).
[[nodiscard]] double cost_of_piece(const Patch& piece, const Folds& tree, std::size_t parts,
                                   const Weights& weights);

/// What a piece of these faces costs at least, whatever its tree is.
[[nodiscard]] double least_cost_of_piece(const Patch& piece, std::size_t parts, const Weights& weights);

}  // namespace ridgecraft::unfold
