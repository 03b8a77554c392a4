// SPDX-License-Identifier: GPL-3.0-or-later
// Laying a forest of folds flat: every tree afresh from its root.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "unfold/patch/patch.hpp"

namespace ridgecraft::unfold {

/// Faces laid flat. Each tree of the folds is one piece, numbered by its smallest face, with a plane of its
/// own.
struct Layout {
  std::vector<Triangle> flat;                     ///< per face: corners in its piece's plane
  std::vector<std::uint32_t> piece;               ///< per face
  std::vector<std::vector<std::uint32_t>> faces;  ///< per piece, in the order of the traversal from its root
};

/// Places every face by one chain of folds from its tree's root, breadth first (short chains, small errors).
/// O(n).
[[nodiscard]] Layout lay_out(const Patch& patch, const Folds& folds);

/// Whether a side is cut only because folds are a tree: its flat region goes on over it, and both copies of
/// it lie at one place. The paper is whole there (pieces/closing.hpp).
[[nodiscard]] bool is_slit(const Patch& patch, const Folds& folds, const Layout& layout, std::uint32_t side);

/// The convex hull of these faces of one piece.
[[nodiscard]] std::vector<Vec2> hull_of(const Layout& layout, std::span<const std::uint32_t> faces);

// The independent check of finished nets: all pairs of faces, by other formulas than the search uses.

struct OverlapFound {
  std::uint32_t first = 0;  ///< indices into the triangles that were given, first < second
  std::uint32_t second = 0;
  double depth = 0.0;  ///< mm
};

/// Penetration depth by the Minkowski difference: the distance from the origin to the outline of the convex
/// hull of all differences of corners; 0 or less when the origin isn't inside. Shares no code with
/// unfold/patch/patch.hpp.
[[nodiscard]] double depth_by_difference(const Triangle& a, const Triangle& b);

/// Every pair of these triangles that is deeper than the tolerance (mm). A sweep over x skips the pairs whose
/// boxes are apart, no other. O(n log n + pairs of boxes that meet).
[[nodiscard]] std::vector<OverlapFound> find_overlaps(std::span<const Triangle> triangles, double tolerance);

/// find_overlaps for each piece of a layout by itself; indices are the layout's faces.
[[nodiscard]] std::vector<OverlapFound> find_overlaps(const Layout& layout, double tolerance);

}  // namespace ridgecraft::unfold
