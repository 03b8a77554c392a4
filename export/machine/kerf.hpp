// SPDX-License-Identifier: GPL-3.0-or-later
// Room for the beam: a laser takes half of its kerf from either side of the line that it follows. And how
// short what a machine does may be: rounding makes shorter paths and steps, and a laser burns holes there.
#pragma once

#include <vector>

#include "base/vector.hpp"

namespace ridgecraft::export_ {

// How short what a machine does may be: rounding makes shorter paths and steps, and a laser burns holes
// there.

/// No path is shorter, mm.
inline constexpr double shortest_path_mm = 0.2;
/// No point of a path is nearer to the one before, mm.
inline constexpr double nearest_points_mm = 0.05;

/// What is cut of one piece, mm.
struct CutPaths {
  std::vector<std::vector<Vec2>> loops;  ///< closed, simple: outlines and holes; they may share corners
  std::vector<std::vector<Vec2>> lines;  ///< open: slits
};

/// The loops of one piece (the outer one and its holes) moved by half of the kerf away from the paper, so
/// that the piece is as large as drawn when the beam has passed. Corners are mitred, but for those that would
/// reach farther than the kerf. Where a gap is narrower than the kerf and 0.05 mm, as towards the tip of
/// every narrow wedge, the moved loops end; there a line in the middle of the gap, from the tip to where they
/// begin, does the cut. Every point of the given loops is within half of the kerf and 0.05 mm of what comes
/// back. A kerf of 0 gives the loops back. O(n log n) for n corners, but for gaps between two corners (n
/// each).
///
/// The loops are added up on a grid of 0.00001 mm (Boost.Polygon); the middle of a gap is an edge of the
/// Voronoi diagram of the sides (Fortune: A sweepline algorithm for Voronoi diagrams, 1987).
[[nodiscard]] CutPaths with_kerf(const std::vector<std::vector<Vec2>>& loops, double kerf_mm);

}  // namespace ridgecraft::export_
