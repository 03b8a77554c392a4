// SPDX-License-Identifier: GPL-3.0-or-later
// Pieces that are equal on paper: who has cut and folded one knows all of them.
#pragma once

#include "mesh/model/surface.hpp"
#include "unfold/net/nets.hpp"

namespace ridgecraft::unfold {

/// Lines of equal pieces lie within this distance of each other, mm: less than a knife can follow.
inline constexpr double equal_pieces_mm = 0.02;

/// Kinds of pieces that there are several of: outlines, folds with their angles, and tabs are the same after
/// a motion, after turning over one of them where it is mirrored. Kinds that differ by nothing but tabs of
/// joins between their pieces are one, which is told (EqualPiece::other_tabs): an ear has those that its
/// mirror image is glued behind. Kinds by their first pieces, pieces ascending; one that needn't be mirrored
/// isn't. O(n log n) but for pieces that are nearly equal.
[[nodiscard]] std::vector<std::vector<EqualPiece>> find_equal_pieces(const mesh::Surface& surface,
                                                                     const Nets& nets);

}  // namespace ridgecraft::unfold
