// SPDX-License-Identifier: GPL-3.0-or-later
// Axes that a surface can be turned about onto itself: petals, spokes, towers.
#pragma once

#include <vector>

#include "mesh/model/surface.hpp"
#include "prepare/symmetry/correspondence.hpp"
#include "prepare/symmetry/isometry.hpp"
#include "prepare/symmetry/mirrors.hpp"

namespace ridgecraft::prepare {

/// A line, and the turn about it that all others of the surface are powers of.
struct Rotation {
  Vec3 point;
  Vec3 axis;           ///< of length 1
  unsigned folds = 2;  ///< the turn is one of so many of a full circle
  Isometry turn;
  Correspondence maps;  ///< of that turn; maps.whole as in Mirror
};

/// Exact axes (every corner has a partner within SymmetryTolerance::exact) among the axes of coordinates, the
/// principal axes of the area, and the lines that exact mirror planes share; those with the most folds first.
/// So those of cubes are found only as far as they have mirror planes. O(n log n) for each line and divisor.
[[nodiscard]] std::vector<Rotation> find_rotations(const mesh::Surface& surface,
                                                   const SymmetryTolerance& tolerance = {});

}  // namespace ridgecraft::prepare
