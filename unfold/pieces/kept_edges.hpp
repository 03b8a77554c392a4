// SPDX-License-Identifier: GPL-3.0-or-later
// Which of the edges that are to be kept can be kept: all of them as folds of clean nets that fit.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "base/context.hpp"
#include "mesh/model/surface.hpp"
#include "prepare/prepared/panels.hpp"
#include "unfold/net/edge_constraints.hpp"
#include "unfold/net/options.hpp"
#include "unfold/patch/problem.hpp"
#include "unfold/pieces/symmetry.hpp"

namespace ridgecraft::unfold {

struct KeptEdges {
  EdgeConstraints constraints;  ///< without what couldn't be kept
  prepare::Panels groups;       ///< panels that kept edges hold together, as one each
};

/// Panels that kept edges hold together must lie flat without overlap and fit the room. All edges between
/// them are tried at once, then, where that fails, one after the other, long ones first. Constraints inside
/// panels and at borders are dropped.
[[nodiscard]] KeptEdges settle_constraints(const mesh::Surface& surface, const prepare::Panels& panels,
                                           const EdgeConstraints& constraints, const Room& room,
                                           const Context& context);

// Walls that go round stay strips.

/// What is requested, and EdgeConstraint::band for the rungs of each band that is rolled (Options::rolls) and
/// of each other one of the surface (pieces/bands.hpp) that is wide: at least 1.1 times as wide as its
/// regions are long on average. A narrower one may as well hang on a disk in single flaps. Of a band that
/// goes all the way round one rung stays free, its seam: as near to the mirror plane as any lies, mirrored
/// where bands are mirrored. Bands with a rung that has a constraint are left as they are, so are those
/// that are folded and on which labels meet, and what crosses a band that is rolled. Where pieces are to be
/// few, those that are rolled are all. O(n log n).
[[nodiscard]] EdgeConstraints with_bands_kept(const UnfoldProblem& problem, const Symmetry& symmetry);

}  // namespace ridgecraft::unfold
