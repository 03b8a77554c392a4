// SPDX-License-Identifier: GPL-3.0-or-later
// How each class of line looks and in which order a page is painted: one table for all formats.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "export/sheet/drawing.hpp"

namespace ridgecraft::export_ {

// In which order a page is painted.

/// Bottom to top, which is the order of work, too, as some machines follow the file: what is printed, what is
/// written, what is folded, what is cut.
inline constexpr std::array<Layer, layer_count> layer_order{
    Layer::paint,      Layer::tab_fill, Layer::shadow, Layer::glue,     Layer::mark, Layer::label,
    Layer::piece_name, Layer::mountain, Layer::valley, Layer::tab_fold, Layer::cut};

// How each class of line looks: one table for all formats.

/// What a line looks like in every format that prints.
struct LineStyle {
  double width = 0.2;  ///< mm
  Color color;
  std::span<const double> dashes;  ///< mm: dash, gap, dash, gap ...; empty for a solid line
};

/// The look of a line on paper.
[[nodiscard]] LineStyle style_of(const Line& line);
/// The fill of areas of a layer that have no colour of their own.
[[nodiscard]] Color fill_of(Layer layer);
/// Around a line or a text whose ground is dark here and light there, mm on each side.
inline constexpr double halo_mm = 0.12;
/// Of lines that meet where polygons of a fill do, mm: wide enough that no viewer shows the ground between
/// them.
inline constexpr double fill_rim_mm = 0.06;
/// The colour of a text's strokes.
[[nodiscard]] Color color_of(const Text& text);

/// The pattern fitted to a line of this length, mm: it begins and ends with its first dash, so that eye and
/// knife find both ends, and shows at least two of them; the result is a dash array for this line alone.
/// Empty (solid) for an empty pattern and for lines below shortest_dashed_mm.
[[nodiscard]] std::vector<double> fitted_dashes(std::span<const double> pattern, double length);

/// The dash array of a line as it is drawn.
[[nodiscard]] std::vector<double> dashes_of(const Line& line);

/// Shorter lines are solid: two dashes and a gap in less than this are a smudge.
inline constexpr double shortest_dashed_mm = 0.8;

}  // namespace ridgecraft::export_
