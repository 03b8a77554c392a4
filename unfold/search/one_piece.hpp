// SPDX-License-Identifier: GPL-3.0-or-later
// Can these faces be one piece? A quick search that is made for many unions of pieces, and one that changes
// the shape of a net until it fits the sheet.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "base/context.hpp"
#include "unfold/patch/patch.hpp"
#include "unfold/patch/problem.hpp"

namespace ridgecraft::unfold {

// A net without overlap changes its shape until it fits the sheet.

/// How far a convex polygon sticks out of a sheet, mm: width and height together, at the best of the turns
/// that lay one of its sides along a side of the sheet. 0: it fits. O(m^2), m corners.
[[nodiscard]] double excess(std::span<const Vec2> hull, const Sheet& sheet);

/// Hangs branches that stick out of the sheet elsewhere, never making an overlap deeper than the tolerance
/// (mm), until the net fits the room or `trials` are spent. `folds`: a spanning tree without overlap. Returns
/// a tree without overlap that sticks out no further; panels stay whole. About 0.05 ms a trial at 100 faces.
[[nodiscard]] Folds shrink_to_fit(const Patch& patch, const Folds& folds, const Room& room, double tolerance,
                                  std::uint64_t trials, std::uint64_t seed, const Context& context);

// Can these faces be one piece? A quick search that is made for many unions of pieces.

struct OnePieceSearch {
  double tolerance = 0.0;  ///< mm
  int starts = 3;          ///< start trees
  std::uint64_t iterations_per_face = 2;
  std::uint64_t fit_trials = 300;  ///< of shrink_to_fit for each clean net
};

struct OnePieceFound {
  std::optional<Folds> tree;
  std::uint64_t cost = 0;  ///< faces times iterations: about four million a second
};

/// A tree of a connected patch, panels whole, that has no overlap and fits the room; none where the search
/// finds none. The first that is found is taken.
[[nodiscard]] OnePieceFound find_one_piece(const Patch& patch, const Room& room, const OnePieceSearch& search,
                                           std::uint64_t seed, const Context& context);

}  // namespace ridgecraft::unfold
