// SPDX-License-Identifier: GPL-3.0-or-later
// Pieces that are equal on paper: who has cut and folded one knows all of them.
#pragma once

#include "mesh/model/surface.hpp"
#include "unfold/net/nets.hpp"

namespace ridgecraft::unfold {

/// Lines of equal pieces lie within this distance of each other, mm: less than a knife can follow.
inline constexpr double equal_pieces_mm = 0.02;

/// Kinds of pieces that there are several of: outlines, and folds with their angles, are the same after a
/// motion, after turning over one of them where it is mirrored. Whether their tabs are, too, is said of each
/// (EqualPiece::other_tabs). Kinds by their first pieces, pieces ascending; one that needn't be mirrored
/// isn't. O(n log n) but for pieces that are nearly equal.
[[nodiscard]] std::vector<std::vector<EqualPiece>> find_equal_pieces(const mesh::Surface& surface,
                                                                     const Nets& nets);

}  // namespace ridgecraft::unfold
