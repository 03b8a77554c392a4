// SPDX-License-Identifier: GPL-3.0-or-later
// Every tolerance of the checks, with unit and reason. Those that the contract states are taken from it to
// the letter.
#pragma once

#include <cstddef>

namespace ridgecraft::verify {

/// Lengths of nets and model (promise 1): absolute part in mm, and the share of the length.
constexpr double length_tolerance_mm = 1e-5;
constexpr double length_tolerance_fraction = 1e-6;
/// Distance of a model polygon's corners from its plane, as a share of the model's size: 1e-4 mm per 100 mm
/// (promise 1).
constexpr double plane_tolerance_fraction = 1e-6;
/// Penetration that still counts as touching, in mm (promise 2).
constexpr double overlap_tolerance_mm = 1e-3;
/// How far faces and tabs may reach out of the printable area, and pages into each other, in mm (promise 4).
constexpr double page_tolerance_mm = 1e-3;
/// Fold angles, in degrees (promise 5).
constexpr double angle_tolerance_deg = 0.01;
/// Below this a fold is flat, in degrees (section 1).
constexpr double flat_fold_deg = 1e-4;
/// Slender faces have badly defined normals: points known to this share of the model's size turn them
/// (promise 5).
constexpr double slender_fraction = 1e-9;
/// Distance of a tab's base from its edge, in mm (promise 5).
constexpr double tab_base_tolerance_mm = 1e-3;
/// Distance of the edges under one tab from its base, in mm (promise 5).
constexpr double seam_tolerance_mm = 1e-2;
/// What a slit keeps from cuts and folds of its piece, in mm (promise 5), 0.01 less than nets keep; and from
/// other slits.
constexpr double least_beside_slit_mm = 2.99;
constexpr double least_between_slits_mm = 0.5;
/// How far a slit may be from where its tab comes to lie, in mm.
constexpr double slit_place_mm = 0.01;
/// Paper behind a tab: along half of its base it must reach so far, in mm (promise 5); 0.01 less than nets
/// keep.
constexpr double least_paper_mm = 1.99;
/// What is bent more is a crease, in degrees (promise 8).
constexpr double most_bend_deg = 35.0;
/// Tighter than this, in mm, paper of 0.2 mm can't be rolled (promise 8); 0.01 less than nets keep.
constexpr double least_bend_radius_mm = 2.99;
/// A region that is so many times as wide as the one beside it is flat beside a bend, which counts by as
/// much.
constexpr double flat_beside_bend = 3.0;
/// Narrower pieces can't be cut out, mm.
constexpr double least_piece_mm = 1.0;
/// Paper narrower than this doesn't hold what hangs on it, mm, where that is larger than this on either side,
/// mm2.
constexpr double least_neck_mm = 1.0;
constexpr double held_by_neck_mm2 = 25.0;
/// Distance of folded corners from the model's vertices, as a share of the model's size: 1e-3 mm per 100 mm
/// (promise 6).
constexpr double position_tolerance_fraction = 1e-5;

/// Folds of less don't move anything that one could see and needn't be in the fold order, in degrees: 2e-6
/// radians.
constexpr double still_fold_deg = 1.15e-4;
/// Faces that run into each other by less than this while a piece is folded pass each other, in mm: card
/// bends as far out of the way, and looks that are taken at a few moments must not find what a finer look
/// would let pass.
constexpr double fold_seam_mm = 0.5;
/// Faces that meet by this much in the folded piece belong to a model that runs through itself, in mm.
constexpr double final_seam_mm = 0.29;
/// Looks at each step of a motion, at equal shares of its way: among those that this program takes when it
/// looks for an order, so that it isn't blamed for what passes between two of them.
constexpr int looks_at_step = 25;
/// Steps times faces of a piece whose motion is looked at: some seconds.
constexpr std::size_t most_fold_work = 100'000;

/// Folds inside a flat region: each face is within 0.1 degrees of the same plane.
constexpr double flat_region_fold_deg = 0.2 + angle_tolerance_deg;
/// What a setting of a length and what follows from it may differ by, as a share: the settings stand in the
/// file with ten digits.
constexpr double setting_tolerance_fraction = 1e-6;
/// By how much the gap between pieces may be less than the settings say, in mm.
constexpr double gap_tolerance_mm = 1e-4;
/// How far a surface that wasn't simplified may be from the model, as a share of its size: flat regions are
/// made quite flat.
constexpr double same_surface_fraction = 5e-5;
/// How far one that was simplified by the program's own choice may be, as a share of its largest extent: a
/// twenty-fifth, and a quarter of that because the file doesn't tell how the simplified surface lay on the
/// model.
constexpr double simplified_fraction = 0.05;
/// How far what is glued on may be from its outline, in mm, and how exactly the place of an outline is known.
constexpr double glue_mm = 0.2;
constexpr double glue_place_mm = 0.03;
/// What nothing else holds may be so far away: glue and card fill that.
constexpr double glue_gap_mm = 1.2;
/// Points nearer than this are one, in mm.
constexpr double same_point_mm = 1e-7;

/// Bodies that may be missing where others became one skin: strips of this width, in mm, ...
constexpr double detail_mm = 6.0;
/// ... or flat sheets, whose normals add up to this share of their area; ...
constexpr double flat_detail_cosine = 0.99;
/// ... no longer than this share of the model; together no more of its area than this.
constexpr double detail_length_fraction = 0.26;
constexpr double details_area_fraction = 0.35;

/// Areas of surfaces that are the same, as a share.
constexpr double area_tolerance_fraction = 1e-3;
/// Samples of surfaces are this share of the largest extent apart, with at most so many steps along a
/// triangle's side.
constexpr double sample_fraction = 0.015;
constexpr double most_sample_steps = 64.0;
/// Coarser ones to find how a simplified surface lies on the model, and how often that is tried.
constexpr double fit_fraction = 0.05;
constexpr int fit_rounds = 12;

/// Larger coordinates are no lengths on paper; up to here doubles are 2e-9 mm apart, far below every
/// tolerance.
constexpr double max_coordinate_mm = 1e7;
/// Two sides of a polygon touch when they come as near as this share of the largest coordinate: some thousand
/// times the rounding of doubles, far below what anybody can cut.
constexpr double touch_fraction = 1e-12;
/// A corner that lies this far inside the chord of its neighbours (mm) doesn't make a polygon concave: a
/// million times smaller than the overlap tolerance, so that even a thousand such corners in a row don't add
/// up to it.
constexpr double dent_tolerance_mm = 1e-9;

/// Lines of pieces that are said to be equal lie within this distance of each other, mm: no knife is led more
/// exactly.
constexpr double equal_pieces_tolerance_mm = 0.05;
/// Their folds differ by no more than this, degrees, and slighter ones than the second needn't be on both.
constexpr double equal_folds_tolerance_deg = 0.5;
constexpr double slightest_fold_deg = 0.25;

/// JSON deeper than this is refused before it takes memory; the contract needs 5.
constexpr int max_json_depth = 64;
/// Work for the depths of overlaps, in distances between a corner and a side, after which the count is given
/// up: 10,000 triangles on one heap are counted to the last pair, and a file made to be slow ends within
/// seconds.
constexpr std::size_t max_overlap_work = 1'000'000'000;
/// Pairs of pages that lie on each other, after which no more are looked for: they bring faults, but no
/// figure.
constexpr std::size_t max_page_overlaps = 1'000'000;

/// Where a file doesn't say from which angle on folds are drawn.
constexpr double default_hidden_deg = 3.0;

// Every tolerance of printed pages, with unit and reason.

/// How finely files hold a place, mm: four decimals in SVG; in PDF 1/256 point (0.0014 mm), of which the file
/// has three decimals, rounded in both directions.
constexpr double rounding_mm = 0.0013;
/// Two lines nearer than this are one line on paper (docs/design/pages.md), mm: a corner may be drawn where
/// its neighbour is.
constexpr double one_line_mm = 0.0105;
/// How far a printed line may be from the line of the nets, mm: its ends may each be drawn at a neighbour,
/// and a line may bend to a corner nearby or leave the bends of a nearly straight chain out, which adds
/// once more. A quarter of a hair; a knife is led ten times less exactly.
constexpr double line_tolerance_mm = 2.0 * one_line_mm + rounding_mm;
/// Sheets and bars have nothing to be bent to, mm.
constexpr double measure_tolerance_mm = 0.01;
/// Up to this distance from a line a fault names the distance, mm: farther away it is another
/// line.
constexpr double beside_mm = 1.0;

/// A page of which this share of the outlines is no line of its page of the nets, and no more than that share
/// of another one's, shows the other page.
constexpr double wrong_page_fraction = 0.5;
constexpr double right_page_fraction = 0.01;

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
constexpr std::size_t max_content_bytes = std::size_t{1} << 26U;
/// Groups within groups of an SVG file.
constexpr int max_group_depth = 32;

}  // namespace ridgecraft::verify
