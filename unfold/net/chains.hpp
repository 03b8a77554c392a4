// SPDX-License-Identifier: GPL-3.0-or-later
// Chains: what is glued together edge by edge, in one go, with one number.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/id.hpp"
#include "mesh/model/surface.hpp"
#include "unfold/net/nets.hpp"

namespace ridgecraft::unfold {

/// Joins in a row: the same edges follow each other on the outlines of both pieces, which may be one piece.
/// It ends where a third edge is cut, at the border, and where the number changes.
struct Chain {
  std::uint32_t number = 0;       ///< of all its joins
  std::array<PieceId, 2> pieces;  ///< on which the sides lie, and the sides beyond
  std::vector<JoinId> joins;      ///< the first before the last
  /// Of each join the side on the first piece, as its outline runs: each begins where the one before ends.
  /// The sides beyond (their twins) follow each other the other way round.
  std::vector<CornerId> sides;
};

/// The chains of these nets; each join is in one. A ring has no ends that show how it lies, so it is two
/// chains: from its sharpest corner to that which is nearest to half way round. Linear but for rings.
[[nodiscard]] std::vector<Chain> chains_of(const mesh::Surface& surface, const Nets& nets);

/// Makes a join of every cut edge, and gives each chain a number, from 1 on. Numbers follow the seams on the
/// model: parts in their order, in each part from chain to neighbouring chain, staying between the same two
/// pieces and going straight on where that is possible, so that neighbours on the model have neighbouring
/// numbers. Joins are in the order in which they follow each other along their chains. Needs use, piece and
/// pieces of `nets`. O(n log n).
void number_joins(const mesh::Surface& surface, Nets& nets);

}  // namespace ridgecraft::unfold
