// SPDX-License-Identifier: GPL-3.0-or-later
// A sheet of paper: its size, by name or in numbers, and which rectangles of it are for pieces and for page
// furniture.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/vector.hpp"

namespace ridgecraft::export_ {

/// Height of the band for title, scale bar, legend and page number, at the foot of the printable area, mm:
/// two lines of 2.5 mm text with a scale bar beside them, and the distance to the pieces above. No piece
/// reaches into it.
inline constexpr double furniture_height = 12.0;

/// How long a search for fewer sheets takes.
enum class PackingEffort {
  fast,  ///< some hundredths of a second
  good,  ///< some tenths
};

/// Which way the paper's fibres run. Folds and rolls along them come out clean; across them paper cracks.
enum class Grain {
  any,         ///< it doesn't matter
  long_side,   ///< along the sheet's long side, as of most paper that is sold cut
  short_side,  ///< along its short side
};

/// A sheet of paper, mm.
struct Paper {
  Vec2 size{210.0, 297.0};
  double margin = 10.0;            ///< on all four sides
  double gap = 2.0;                ///< between the outlines of neighbouring pieces, tabs included
  double foot = furniture_height;  ///< of the band within the margins at the foot that pieces keep out of, mm
  double head = 0.0;               ///< the same at the top
  bool furniture = true;           ///< whether title, scale bar and legend stand at the foot
  PackingEffort packing = PackingEffort::fast;
  Grain grain = Grain::any;
};

/// "A4", "letter", "jis-b5", "a3-landscape", "210x297mm", "8.5x11in", "210x297" (mm); letter case doesn't
/// matter. Throws Error(usage) with the nearest name known, or with what is wrong with the numbers.
[[nodiscard]] Paper parse_paper(std::string_view text);

/// The names that parse_paper knows, as a person writes them, each also with "-landscape".
[[nodiscard]] std::vector<std::string> paper_names();

/// Throws Error(usage) where a size, a margin or a gap is negative or no number, or where the margins and the
/// furniture leave less than 20 mm for pieces.
void check_paper(const Paper& paper);

/// The rectangle in which pieces lie, on the page (origin: lower left corner of the sheet, y up).
[[nodiscard]] Box2 piece_box(const Paper& paper);

/// Its width and height: what a piece must fit, with its tabs.
[[nodiscard]] Vec2 piece_area(const Paper& paper);

}  // namespace ridgecraft::export_
