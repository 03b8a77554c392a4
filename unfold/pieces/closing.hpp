// SPDX-License-Identifier: GPL-3.0-or-later
// Cuts that would be slits in flat paper become folds, and what holes a piece then has.
#pragma once

#include "mesh/model/surface.hpp"
#include "prepare/prepared/panels.hpp"
#include "unfold/net/edge_constraints.hpp"
#include "unfold/net/nets.hpp"

namespace ridgecraft::unfold {

/// Turns a cut into a fold where its two copies lie on each other (within closing_tolerance_mm) in one piece
/// and either both faces belong to one panel, or it is the last cut at a vertex of which all faces lie in the
/// piece: round a vertex without curvature the paper closes. What is to be cut stays cut. Needs use, piece
/// and flat of `nets`. O(n).
void close_flat_cuts(const mesh::Surface& surface, const prepare::Panels& panels,
                     const EdgeConstraints& constraints, Nets& nets);

/// Sets Piece::holes by Euler's number of each piece as it hangs together over its folds. O(n log n).
void count_holes(const mesh::Surface& surface, Nets& nets);

}  // namespace ridgecraft::unfold
