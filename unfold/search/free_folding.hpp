// SPDX-License-Identifier: GPL-3.0-or-later
// A piece that runs through itself while it is folded gets another tree, if there is one near that doesn't.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "base/context.hpp"
#include "unfold/patch/patch.hpp"

namespace ridgecraft::unfold {

/// Whether each net of these folds folds up with all creases together without running through itself.
[[nodiscard]] bool folds_together(const Patch& patch, const Folds& folds, const Context& context);

/// What a tree must be to take the place of one that doesn't fold together.
struct FreeFoldingRules {
  double tolerance = 0.0;  ///< of overlap, mm
  /// What a tree costs, in any unit; nothing where it isn't allowed, as where it doesn't fit the sheet.
  std::function<std::optional<double>(const Folds&)> cost;
  double worth = 0.0;  ///< what it may cost more than the given one, in that unit
};

/// For a tree that doesn't fold up with all creases together one that does, if one is found that is worth it:
/// of several the cheapest of those with the shortest cuts. They are found by walks from the given tree, on
/// which folds between faces that meet on the way (or overlap) are exchanged. About 0.02 s for a piece of 50
/// faces that doesn't fold together. Deterministic for one seed except for the deadline.
[[nodiscard]] std::optional<Folds> fold_freely(const Patch& piece, const Folds& given,
                                               const FreeFoldingRules& rules, std::uint64_t seed,
                                               const Context& context);

}  // namespace ridgecraft::unfold
