// SPDX-License-Identifier: GPL-3.0-or-later
// Where no tree without overlap was found, the best one is cut until no piece overlaps itself.
#pragma once

#include <cstdint>

#include "unfold/patch/patch.hpp"

namespace ridgecraft::unfold {

/// Removes folds until no two faces of one piece are deeper in each other than the tolerance (mm). Each time
/// the fold goes that lies on the tree paths of the most overlapping pairs (greedy set cover, V. Chvatal
/// 1979; the idea for nets: R. Straub, H. Prautzsch 2011), panels last; among equals the one that leaves the
/// most balanced pieces. O((n + pairs) log n) for balanced cuts, O((n + pairs) cuts) at worst.
[[nodiscard]] Folds split_overlaps(const Patch& patch, const Folds& folds, double tolerance);

/// The fold of a tree that would go first if these pairs of faces were the overlaps; no_index where only
/// folds that have to stay part any. O(n + pairs log n).
[[nodiscard]] std::uint32_t best_parting_fold(const Patch& patch, const Folds& tree, const FacePairs& pairs);

}  // namespace ridgecraft::unfold
