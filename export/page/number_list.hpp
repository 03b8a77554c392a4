// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers that have no room at their edges, as words: which edges they belong to.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "export/page/piece_drawing.hpp"
#include "export/sheet/paper.hpp"

namespace ridgecraft::export_ {

/// What stands above the rows of number_row().
inline constexpr std::string_view number_list_heading =
    "numbers without room at their edges, clockwise round their piece";

/// "E: after 12 come 13, 14, then 21": the piece's numbers that stand nowhere else (NumberAt::list), among
/// those at edges in the order in which they follow each other clockwise on the printed side. Where a whole
/// outline has no number: "all round, from the longest edge: 13, 14, 15". Empty where all numbers stand
/// elsewhere. O(seams).
[[nodiscard]] std::string number_row(const PieceDrawing& piece);

/// Whether a page of this paper can hold such a list.
[[nodiscard]] bool has_room_for_lists(const Paper& paper);

}  // namespace ridgecraft::export_
