// SPDX-License-Identifier: GPL-3.0-or-later
// A piece that runs through itself while it is folded gets another tree, if there is one near that doesn't.
#pragma once

#include <cstdint>
#include <functional>

#include "mesh/foundation/context.hpp"
#include "unfold/search/patch.hpp"

namespace ridgecraft::unfold {

/// Whether the net of this tree folds up in one of the ways of fold_order.hpp without running through itself.
[[nodiscard]] bool folds_freely(const Patch& piece, const Folds& tree, const Context& context);

/// A tree of the piece that folds up freely in one of the ways of fold_order.hpp: the given one if it does,
/// otherwise one that is found by exchanging folds between faces that meet on the way, as long as no more of
/// them do; the given one where none is found. No net of it overlaps deeper than `tolerance` (mm), and
/// `allowed` says yes to it. About 0.1 s for a piece of 100 faces that doesn't fold freely. Deterministic for
/// one seed but for the deadline.
[[nodiscard]] Folds fold_freely(const Patch& piece, const Folds& tree,
                                const std::function<bool(const Folds&)>& allowed, double tolerance,
                                std::uint64_t seed, const Context& context);

}  // namespace ridgecraft::unfold
