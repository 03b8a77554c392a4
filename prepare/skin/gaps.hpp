// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies that end just before others touch them. Private to prepare/.
#pragma once

#include <cstddef>
#include <vector>

#include "base/context.hpp"
#include "base/vector.hpp"
#include "mesh/model/surface.hpp"

namespace ridgecraft::prepare {

/// Bodies this far from each other, as a share of the model's diagonal, are meant to touch: a tenth of a
/// millimetre, half a sheet of paper, on a model with a diagonal of 200 mm.
inline constexpr double touching = 5e-4;

/// Where the corners of a surface come to lie.
struct ClosedGaps {
  std::vector<Vec3> points;  ///< of all vertices
  std::size_t moved = 0;     ///< how many of them have moved
};

/// Moves corners of solid components that lie before another solid component's face, up to `most` away, along
/// one of their edges, so that the planes of the faces beside that edge stay, until they are `least` behind
/// the face. Of two components the smaller one moves, if three of its corners or more do. Corners that are
/// within `least` of another component stay, for they touch already. O(n log n).
[[nodiscard]] ClosedGaps close_gaps(const mesh::Surface& surface, const std::vector<bool>& solid,
                                    double least, double most, const Context& context);

}  // namespace ridgecraft::prepare
