// SPDX-License-Identifier: GPL-3.0-or-later
// Letters as lines: a single-stroke alphabet of our own. All formats show the same shapes, boxes are known
// exactly, no font has to be installed or embedded, and a plotter can draw it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "export/sheet/drawing.hpp"

namespace ridgecraft::export_ {

/// Pen width for a text of this height, mm: a ninth of it reads well at 1.6 to 5 mm. Piece names are drawn
/// bolder.
[[nodiscard]] double pen_width(const Text& text);

/// Whether every character of the UTF-8 text is in the alphabet: ASCII, the letters of Latin-1, a few signs.
[[nodiscard]] bool stroke_font_covers(std::string_view utf8);

/// Width of the text, mm, from the first pen position to the last (without the pen's own width). For a text
/// that the alphabet doesn't cover an estimate that is rather too large than too small.
[[nodiscard]] double text_width(std::string_view utf8, double height);

/// The words in rows no wider than `width`, mm, those after the first by `hanging` less. A word that is wider
/// by itself has a row of its own.
[[nodiscard]] std::vector<std::string> wrapped(std::string_view words, double width, double height,
                                               double hanging = 0.0);

/// As many of the letters as have room, with "…" at the end where some haven't.
[[nodiscard]] std::string shortened(std::string_view words, double width, double height);

/// The lines of the text at its place in the drawing. Empty if the alphabet doesn't cover it: then a format
/// has to fall back to a font of the system (height times font_size_per_height is the em).
[[nodiscard]] std::vector<std::vector<Vec2>> text_strokes(const Text& text);

/// Font size that gives capital letters of height 1 in the sans-serif fonts one meets (Arial 0.716 em, DejaVu
/// 0.729).
inline constexpr double font_size_per_height = 1.0 / 0.72;

/// Distance of the line under a number that could be read upside down, below its baseline, as a share of its
/// height.
inline constexpr double underline_drop = 0.26;

}  // namespace ridgecraft::export_
