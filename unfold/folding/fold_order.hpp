// SPDX-License-Identifier: GPL-3.0-or-later
// Can a piece be folded up without running through itself, and in which order? Self-folding sheets can't help
// themselves with a finger, and makers like to know before they glue.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "base/context.hpp"
#include "mesh/model/surface.hpp"
#include "unfold/folding/fold_motion.hpp"
#include "unfold/folding/fold_trial.hpp"
#include "unfold/net/nets.hpp"

namespace ridgecraft::unfold {

/// A way to fold, and the creases in their order (none where all are folded at a time).
struct Folding {
  FoldWay way = FoldWay::together;
  std::vector<std::uint32_t> order;
  /// Two faces that stop the search where it came farthest: there where no order was found in spite of it.
  std::optional<FoldTrial::Pair> in_the_way = std::nullopt;
};

/// The first of these ways in which no two faces of the piece meet, found by sampled motion: all creases at a
/// time, growing alike; one after the other, the outermost first; one after the other from the middle; one
/// after the other in the order that opening the folded piece backwards gives (opening.hpp). Where each way
/// fails it is `with_care`, in the second order. Single creases are tried where their number times that of
/// the faces is no more than a million: about a thousand flat regions. Tabs are not looked at. Deterministic
/// but for the deadline.
[[nodiscard]] Folding find_folding(const FoldMotion& motion, FoldTrial& trial, const Context& context);

/// The same without the first way, which is known to fail.
[[nodiscard]] Folding find_order(const FoldMotion& motion, FoldTrial& trial, const Context& context);

/// The same for a finished piece, edge by edge.
[[nodiscard]] FoldOrder find_fold_order(const mesh::Surface& surface, const Nets& nets, PieceId piece,
                                        const Context& context);

}  // namespace ridgecraft::unfold
