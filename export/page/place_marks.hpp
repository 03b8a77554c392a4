// SPDX-License-Identifier: GPL-3.0-or-later
// Where on a piece an enlarged picture lies: a thin frame, and a letter in a ring that the picture bears,
// too.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "export/page/page_marks.hpp"
#include "export/page/piece_drawing.hpp"

namespace ridgecraft::paper {

/// What a picture shows: a part of which piece.
struct PicturePlace {
  std::size_t page = 0;   ///< from 0
  std::size_t piece = 0;  ///< its place among those of the page
  Box2 window;            ///< on that page
  /// As picture_letter() names it. None where the picture has the whole piece: nobody looks for that.
  std::string letter;
};

/// Of the picture with this number, from 0: "a", "b", ..., "z", "aa". Small letters, since capitals are names
/// of pieces, and without i, l and o, which look like digits.
[[nodiscard]] std::string picture_letter(std::size_t number);

/// Its largest ring, mm from the middle.
[[nodiscard]] double ring_radius(std::string_view letter);
/// The letter in that ring around a point.
[[nodiscard]] PageMarks ringed(std::string_view letter, Vec2 middle);

/// Marks the places of one page's pictures on its pieces. `beside` is what stands on the page but for its
/// pieces. Frames are drawn where they run along no other line, and nowhere on other pieces, texts and
/// pictures. Rings stand on their frame or at the end of a leader from it, clear of all lines and texts; on
/// the piece, where there is room, else where it is cut away; where there is room for none, there is none.
/// O(pictures x lines of the page).
void mark_places(std::vector<PieceDrawing>& pieces, std::span<const PicturePlace> pictures,
                 const PageMarks& beside, Vec2 page_size, const Box2& area);

}  // namespace ridgecraft::paper
