// SPDX-License-Identifier: GPL-3.0-or-later
// Several pieces searched as one tree: they hang together by links, over which they lie far from each other.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "unfold/patch/patch.hpp"

namespace ridgecraft::unfold {

/// Links are sides where a forest's pieces meet, as many as make one tree of it.
struct LinkedPatch {
  Patch apart;   ///< links are borders: what the pieces are
  Patch joined;  ///< links are folds that stay: what a search of one tree works on

  /// More links would lay pieces too far off for the search to be quick.
  static constexpr std::size_t most_links = 16;
};

/// `links`: one side of each, at most LinkedPatch::most_links. A swap of a cut and a fold in the joined patch
/// changes a piece or hands a branch of one to another, their number stays. Over each link the other face is
/// laid twice as far away as over the one before. Pieces that meet all the same only keep out of each other's
/// way for no reason. O(n).
[[nodiscard]] LinkedPatch linked_patch(const Patch& patch, std::span<const std::uint32_t> links);

/// Sides at which trees meet, one of each, long ones first. `piece`: the tree of each face. O(n log n).
[[nodiscard]] std::vector<std::uint32_t> borders_of_trees(const Patch& patch,
                                                          std::span<const std::uint32_t> piece);

}  // namespace ridgecraft::unfold
