// SPDX-License-Identifier: GPL-3.0-or-later
// Where pieces lie when others lie already: layout around them, and the place nearest to where a piece is
// held.
#pragma once

#include <cstdint>
#include <optional>
#include <variant>

#include "base/context.hpp"
#include "base/id.hpp"
#include "base/vector.hpp"
#include "export/sheet/pages.hpp"
#include "export/sheet/paper.hpp"
#include "unfold/net/nets.hpp"

namespace ridgecraft::export_ {

// Pages of nets that have changed here and there: what lies well stays, and the rest finds room around it.

/// How firmly a piece lies where it lies, from the least on.
enum class Hold : std::uint8_t {
  changed,  ///< it looks otherwise than it did there, and goes elsewhere where it has no room
  lying,    ///< it lay there, and stays
  laid,     ///< the user has laid it there, and nothing else will do
};

/// Where a piece is to lie. Pages may be skipped, and come in the order of their numbers.
struct KeptPlace {
  Placement at;
  Hold hold = Hold::lying;
};

/// Why a piece can't lie where it was laid.
struct NoPlace {
  /// What stands in the way.
  enum class Why : std::uint8_t {
    beyond_sheet,  ///< it would leave the rectangle for pieces
    too_near,      ///< to the other one: on it, or nearer than the gap
    other_sort,    ///< pieces of another sort lie on that page, the other one among them
  };
  PieceId piece;
  PieceId other;  ///< none with `beyond_sheet`
  Why why = Why::beyond_sheet;
};

/// Places as many pieces as it can where they are kept, first those that are held most firmly, then large
/// ones; the others, from the largest on, where there is room: on the page that they lay on, on another one,
/// or together on new ones. The rest is as layout() does it. Pages without pieces are left out. Throws
/// Error(no_nets) naming a piece that fits no page. O(n log n) in faces and tabs on pages that are looked at,
/// but for the search for room.
[[nodiscard]] std::variant<Pages, NoPlace> layout_around(
    const unfold::Nets& nets, const Paper& paper, const IdVector<PieceId, std::optional<KeptPlace>>& kept,
    const Context& context, const LayoutRules& rules = {});

/// The place nearest to where the piece is held, in steps of about a millimetre, where it lies on the sheet
/// and keeps the paper's gap to all others, which lie as `pages` has them. It stays on its page, which may be
/// one behind the last, and turned as it is. None within `reach_mm`. Sorts don't matter. O(n) and, for each
/// place that is tried, the pairs of faces and tabs that may come near each other.
[[nodiscard]] std::optional<Placement> nearest_place(const unfold::Nets& nets, const Pages& pages,
                                                     PieceId piece, const Placement& held, double reach_mm);

}  // namespace ridgecraft::export_
