// SPDX-License-Identifier: GPL-3.0-or-later
// Turned bodies (columns, wheels, bottles): fewer sides, evenly around. Private to prepare/.
#pragma once

#include <cstddef>

#include "base/context.hpp"
#include "mesh/model/model.hpp"
#include "mesh/repair/loose_faces.hpp"
#include "prepare/prepared/options.hpp"

namespace ridgecraft::prepare {

/// What becomes of a model's turned bodies.
struct Turning {
  std::size_t found = 0;    ///< those that were turned
  std::size_t changed = 0;  ///< those of them that get fewer sides
  mesh::LooseFaces faces;   ///< all of the model, if any has changed
};

/// A component whose points lie on rings about an axis, equally many (12 or more) and evenly spaced on each,
/// is one that was turned. Where it can't be folded as it is (fold_figures.hpp), or has more faces than
/// anybody builds, its rings become regular polygons of fewer corners, and rings between which its outline
/// hardly bends are left out: the largest number of faces that can be folded, while the surface moves by
/// `largest_mm` at most. Collapses, edge by edge, would leave it lopsided. Components that this doesn't make
/// foldable stay as they are. Faces keep material and object. O(n log n) for each component that is turned;
/// nearly all others are told apart in linear time.
[[nodiscard]] Turning turn_bodies(const mesh::Model& model, const SimplifyOptions& options, double largest_mm,
                                  const Context& context);

/// Does so to the model; returns how many have changed.
std::size_t simplify_turned(mesh::Model& model, const SimplifyOptions& options, double largest_mm,
                            const Context& context);

}  // namespace ridgecraft::prepare
