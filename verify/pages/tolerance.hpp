// SPDX-License-Identifier: GPL-3.0-or-later
// Every tolerance of printed pages, with unit and reason.
#pragma once

#include <cstddef>

namespace ridgecraft::verify {

/// How finely files hold a place, mm: four decimals in SVG; in PDF 1/256 point (0.0014 mm), of which the file
/// has three decimals, rounded in both directions.
constexpr double rounding_mm = 0.0013;
/// Two lines nearer than this are one line on paper (docs/design/pages.md), mm: a corner may be drawn where
/// its neighbour is.
constexpr double one_line_mm = 0.0105;
/// How far a printed line may be beside the line of the nets, mm: its ends may each be drawn at a neighbour,
/// and a line may bend to a corner beside it or leave the bends of a nearly straight chain out, which adds
/// once more. A quarter of a hair; a knife is led ten times less exactly.
constexpr double line_tolerance_mm = 2.0 * one_line_mm + rounding_mm;
/// Sheets and bars have nothing to be bent to, mm.
constexpr double measure_tolerance_mm = 0.01;
/// How far from a line it is still told by how much it is beside its place, mm: farther away it is another
/// line.
constexpr double beside_mm = 1.0;

/// A page of which this share of the outlines is no line of its page of the nets, and no more than that share
/// of another one's, shows the other page.
constexpr double wrong_page_share = 0.5;
constexpr double right_page_share = 0.01;

/// Shorter lines are drawn solid, whatever they are, mm: two dashes and a gap in less are a smudge.
constexpr double shortest_dashed_mm = 0.8;

/// The bars of a page, longest first, and the width of the printable area from which on it has the first and
/// the second of them for sure, mm.
constexpr double bar_lengths_mm[] = {50.0, 20.0, 10.0};
constexpr double bar_room_mm[] = {70.0, 40.0};

/// Colours as bright as this in every part are the paper's.
constexpr double white = 0.94;

/// Forms within forms, and bytes of content of one file, after which it counts as made to be slow.
constexpr int max_form_depth = 8;
constexpr std::size_t max_content_bytes = std::size_t{1} << 28U;
/// Groups within groups of an SVG file.
constexpr int max_group_depth = 32;

}  // namespace ridgecraft::verify
