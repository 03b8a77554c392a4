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

/// Whether all trees of a connected patch lay it flat in the same way, to a tenth of `tolerance` (mm), as
/// they do where the faces around each of its points close flat. Then what overlaps under one tree does so
/// under all. O(n).
[[nodiscard]] bool lies_one_way(const Patch& patch, const Folds& tree, double tolerance);

/// Whether a side is cut only because folds are a tree: its flat region goes on over it, and both copies of
/// it lie at one place. The paper is whole there (pieces/closing.hpp).
[[nodiscard]] bool is_slit(const Patch& patch, const Folds& folds, const Layout& layout, std::uint32_t side);

/// The convex hull of these faces of one piece.
[[nodiscard]] std::vector<Vec2> hull_of(const Layout& layout, std::span<const std::uint32_t> faces);

}  // namespace ridgecraft::unfold
