// SPDX-License-Identifier: GPL-3.0-or-later
// A patch for which the first search found no net: a proof that there is none, a longer search, or few
// pieces.
#pragma once

#include <cstddef>
#include <cstdint>

#include "base/context.hpp"
#include "unfold/patch/patch.hpp"
#include "unfold/search/net_search.hpp"

namespace ridgecraft::unfold {

struct FewestPieces {
  Folds folds;  ///< a forest without overlap, as large as it likes; one tree where a net was found after all
  std::size_t pieces = 0;
  /// No forest has fewer trees than this, by looking at all: at least 2 where no single net exists.
  std::size_t proven_least = 1;
};

/// In this order: the best tree is cut where it overlaps (overlap_split.hpp), and joined where that is
/// possible; all forests are looked at, where the patch is small enough (least_forest.hpp); one tree is
/// searched for with patience (heated_search.hpp), then two or more that are linked (linked_patch.hpp), so
/// that branches go from one to the other, fewer than the cuts left. About two seconds at most. `failed`: the
/// best tree that find_net found. Deterministic for one seed but for the deadline.
[[nodiscard]] FewestPieces fewest_pieces(const Patch& patch, const NetFound& failed, double tolerance,
                                         std::uint64_t seed, const Context& context);

}  // namespace ridgecraft::unfold
