// SPDX-License-Identifier: GPL-3.0-or-later
// Every tolerance of the checks, with unit and reason. Those that the contract states are taken from it to
// the letter.
#pragma once

#include <cstddef>

namespace ridgecraft::verify {

/// Lengths of nets and model (promise 1): absolute part in mm, and the share of the length.
constexpr double length_tolerance_mm = 1e-5;
constexpr double length_tolerance_share = 1e-6;
/// Corners of a model polygon beside its plane, as a share of the model's size: 1e-4 mm per 100 mm (promise
/// 1).
constexpr double plane_tolerance_share = 1e-6;
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
constexpr double slender_share = 1e-9;
/// A tab's base beside its edge, in mm (promise 5).
constexpr double tab_base_tolerance_mm = 1e-3;
/// The edges under one tab beside its base, in mm (promise 5).
constexpr double seam_tolerance_mm = 1e-2;
/// Folded corners beside the model's vertices, as a share of the model's size: 1e-3 mm per 100 mm (promise
/// 6).
constexpr double position_tolerance_share = 1e-5;

/// Larger coordinates are no lengths on paper; up to here doubles are 2e-9 mm apart, far below every
/// tolerance.
constexpr double max_coordinate_mm = 1e7;
/// Two sides of a polygon touch when they come as near as this share of the largest coordinate: some thousand
/// times the rounding of doubles, far below what anybody can cut.
constexpr double touch_share = 1e-12;
/// A corner that lies this far inside the chord of its neighbours (mm) doesn't make a polygon concave: a
/// million times smaller than the overlap tolerance, so that even a thousand such corners in a row don't add
/// up to it.
constexpr double dent_tolerance_mm = 1e-9;

/// JSON deeper than this is refused before it takes memory; the contract needs 5.
constexpr int max_json_depth = 64;
/// Work for the depths of overlaps, in distances between a corner and a side, after which the count is given
/// up: 10,000 triangles on one heap are counted to the last pair, and a file made to be slow ends within
/// seconds.
constexpr std::size_t max_overlap_work = 1'000'000'000;
/// Pairs of pages that lie on each other, after which no more are looked for: they bring faults, but no
/// figure.
constexpr std::size_t max_page_overlaps = 1'000'000;

}  // namespace ridgecraft::verify
