// SPDX-License-Identifier: GPL-3.0-or-later
// Rows of small words on a page: how they are set, where there is room for them, and which edges the
// numbers belong to that have no room on their pieces.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "export/page/obstacles.hpp"
#include "export/page/piece_drawing.hpp"
#include "export/sheet/drawing.hpp"
#include "export/sheet/paper.hpp"

namespace ridgecraft::export_ {

inline constexpr double table_text_height = 1.9;  ///< mm
inline constexpr double table_row_height = 3.1;   ///< baseline to baseline, mm

/// Appends words in rows no wider than `width` (mm), those after the first one indented. A word that is wider
/// by itself has a row of its own.
void append_wrapped(std::vector<std::string>& rows, std::string_view text, double width);

/// The rows with their upper left corner at the origin.
[[nodiscard]] std::vector<Text> table(const std::vector<std::string>& rows);

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

/// All that is drawn on the page, and where its pieces are. Keeps a reference to these.
class PageRoom {
 public:
  PageRoom(const Paper& paper, const std::vector<PieceDrawing>& pieces);

  /// The texts at the lowest place that has room, the leftmost of those. They don't count as being there
  /// until add(). O(places tried x texts).
  [[nodiscard]] std::optional<std::vector<Text>> place(const std::vector<Text>& texts) const;

  void add(const std::vector<Text>& texts);

 private:
  /// Whether there is room for a text of this height that covers `text` around its centre.
  [[nodiscard]] bool free(TurnedBox text, double height, Vec2 centre) const;
  [[nodiscard]] bool on_a_piece(Vec2 p) const;

  Box2 area_;
  Obstacles obstacles_;
  const std::vector<PieceDrawing>& pieces_;
};

}  // namespace ridgecraft::export_
