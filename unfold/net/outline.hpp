// SPDX-License-Identifier: GPL-3.0-or-later
// Takes a closed chain that may touch itself apart into simple loops and slits.
#pragma once

#include <vector>

#include "base/vector.hpp"
#include "mesh/model/surface.hpp"
#include "unfold/net/nets.hpp"

namespace ridgecraft::unfold {

/// What the knife follows, each line once.
struct CutLines {
  /// Simple closed polygons that don't share a stretch: the outer one first (counterclockwise), then holes
  /// (clockwise), both of the patch and of the plane where the piece runs around a gap and touches itself.
  /// Two of them may share single corners.
  std::vector<std::vector<Vec2>> loops;
  /// Open lines inside the piece where two parts of its outline lie on each other.
  std::vector<std::vector<Vec2>> slits;
};

/// `loops` bound one connected region, which lies to their left; they may touch themselves and each other,
/// but don't cross by more than `tolerance`. See CutLines for what comes back. O(n log n).
[[nodiscard]] CutLines arrange_cuts(const std::vector<std::vector<Vec2>>& loops, double tolerance);

// The outline of a piece: what the knife follows, with the tabs spliced in.

/// Two places of an outline that are closer than this are one, mm: just above the 0.01 mm within which two
/// lines count as one line drawn twice (a short edge that opens slowly beside a long one stays below that all
/// along), and a tenth of what a knife or a printer can place.
inline constexpr double touch_tolerance_mm = 0.0105;

/// The boundary side that follows side c, which is one, around its piece: through all folds of the fan at c's
/// end.
[[nodiscard]] CornerId next_boundary(const mesh::Surface& surface, const Nets& nets, CornerId c);

/// Closed polygons that bound a piece with its tabs, mm, in the plane of the piece; the last corner is joined
/// to the first. The outer one comes first and runs counterclockwise, holes of the patch follow and run
/// clockwise. The chain is the exact one of the net's boundary edges: it goes on from a corner to the corner
/// that a fan of folds connects with it, so a slit that lies closed is run there and back, and a loop may
/// touch itself. Whoever fills or measures areas can use it as it is; whoever draws lines uses cut_lines().
/// O(n log n) in the faces of the piece, and O(t) in the tabs of all pieces.
[[nodiscard]] std::vector<std::vector<Vec2>> outline(const mesh::Surface& surface, const Nets& nets,
                                                     PieceId piece);

/// The outline as lines: corners closer than touch_tolerance_mm become one, stretches that lie on each other
/// become a slit, and where the outline touches itself it is taken apart into simple loops, each around one
/// region outside the piece (the piece is connected, so there is always such a way). Slits that tabs are put
/// through are among the slits. O(n log n), and O(t) in
/// the tabs of all pieces.
[[nodiscard]] CutLines cut_lines(const mesh::Surface& surface, const Nets& nets, PieceId piece);

/// Smallest rectangle parallel to the axes around a piece with its tabs, mm. O(n) in the faces of the piece,
/// and O(t) in the tabs of all pieces.
[[nodiscard]] Box2 extent(const mesh::Surface& surface, const Nets& nets, PieceId piece);

}  // namespace ridgecraft::unfold
