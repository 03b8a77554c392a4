// SPDX-License-Identifier: GPL-3.0-or-later
// Pieces that can lie together become one.
#pragma once

#include <cstddef>
#include <cstdint>

#include "base/context.hpp"
#include "base/random.hpp"
#include "unfold/patch/patch.hpp"
#include "unfold/patch/problem.hpp"
#include "unfold/search/net_search.hpp"

namespace ridgecraft::unfold {

/// Folds cuts between two pieces wherever the joined piece has no overlap deeper than the tolerance (mm) and
/// fits the room, cuts in panels and long cuts first, until no more can be joined. Stops after `pair_budget`
/// pairs of faces were compared. With `random` the order is blurred, so that another call may end otherwise.
[[nodiscard]] Folds merge_pieces(const Patch& patch, const Folds& folds, const Room& room, double tolerance,
                                 std::uint64_t pair_budget, const Context& context, Random* random = nullptr);

// Where no tree without overlap was found, the best one is cut until no piece overlaps itself.

/// Removes folds until no two faces of one piece are deeper in each other than the tolerance (mm). Each time
/// the fold goes that lies on the tree paths of the most overlapping pairs (greedy set cover, V. Chvatal
/// 1979; the idea for nets: R. Straub, H. Prautzsch 2011), panels last; among equals the one that leaves the
/// most balanced pieces. O((n + pairs) log n) for balanced cuts, O((n + pairs) cuts) at worst.
[[nodiscard]] Folds split_overlaps(const Patch& patch, const Folds& folds, double tolerance);

// A patch for which the first search found no net: a proof that there is none, a longer search, or few
// pieces.

struct FewestPieces {
  Folds folds;  ///< a forest without overlap, as large as it likes; one tree where a net was found after all
  std::size_t pieces = 0;
  /// No forest has fewer trees than this, by looking at all: at least 2 where no single net exists.
  std::size_t proven_least = 1;
};

/// In this order: the best tree is cut where it overlaps, and joined where that is
/// possible; all forests are looked at, where the patch is small enough (least_forest.hpp); one tree is
/// searched for with patience (heated_search.hpp), then two or more that are linked (patch.hpp), so
/// that branches go from one to the other, fewer than the cuts left. About two seconds at most. `failed`: the
/// best tree that find_net found. Deterministic for one seed but for the deadline.
[[nodiscard]] FewestPieces fewest_pieces(const Patch& patch, const NetFound& failed, double tolerance,
                                         std::uint64_t seed, const Context& context);

}  // namespace ridgecraft::unfold
