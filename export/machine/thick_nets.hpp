// SPDX-License-Identifier: GPL-3.0-or-later
// Nets of board: what is as thick as the model is fine can't be folded along the edges of a surface without
// thickness.
#pragma once

#include <cstddef>
#include <string_view>

#include "prepare/prepared/prepared.hpp"
#include "unfold/net/nets.hpp"

namespace ridgecraft::export_ {

/// Where a fold turns, seen from the printed side.
enum class Hinge {
  back,    ///< at the back skin: the board is scored from the printed side
  middle,  ///< in the middle: it is creased or perforated
  front,   ///< at the printed side: it is grooved from behind
};

/// What the sheets are that pieces are cut from, and how they are folded.
struct Board {
  double thickness_mm = 0.0;  ///< 0: paper, whose nets stay as they are
  Hinge hinge = Hinge::middle;
};

/// What couldn't be done as asked.
struct ThickReport {
  std::size_t clamped = 0;  ///< sides whose change would have taken more than a third of their face
  std::size_t kept = 0;     ///< pieces that stay as thin ones, as they would have lain on themselves
};

/// The nets as they are cut from board, so that the printed side of the built model is the model's surface.
/// Every side of a flat part of a piece moves in its plane, by what `side_change` tells; a part is what its
/// moved sides bound, and parts lie beside each other along their folds, whose corners no longer meet. Tabs
/// get lower by the thickness. Below 0.3 mm bases of tabs alone change: paper yields. O(n log n).
[[nodiscard]] unfold::Nets thick_nets(const prepare::Prepared& model, const unfold::Nets& nets,
                                      const Board& board, ThickReport* report = nullptr);

/// What a side of a flat part is.
enum class BoardSide {
  fold,        ///< of the same piece on either side
  tab_base,    ///< a tab grows from it
  tab_target,  ///< a tab is glued behind it
  mitre,       ///< a join without a tab
  border,
};

/// How far such a side moves outwards, mm, for a signed fold angle (radians, mountain folds negative): see
/// docs/design/machines.md for the sections that these formulas are taken from.
[[nodiscard]] double side_change(BoardSide side, double angle, const Board& board);

}  // namespace ridgecraft::export_
