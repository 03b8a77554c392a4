// SPDX-License-Identifier: GPL-3.0-or-later
// What is closed before bodies are united: their openings, and gaps between them. Private to prepare/.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/context.hpp"
#include "base/vector.hpp"
#include "mesh/model/surface.hpp"

namespace ridgecraft::prepare {

/// One opening and what closes it: triangles that run along it against the surface, as a face there would.
struct Cap {
  std::vector<std::array<VertexId, 3>> triangles;
  bool bent = false;  ///< the opening isn't flat, so this is a guess
};

/// The caps of a component, one for each of its openings: in the plane of a flat one, else the triangles over
/// its corners with the least area (Barequet and Sharir, Filling gaps in the boundary of a polyhedron, 1995),
/// where there are at most 60. Empty where an opening can't be closed, or where the component with its caps
/// would hold next to nothing: a sheet. `flat`: how far points of a flat opening may be from its plane.
/// `faces`: those of the component. O(n log n), and for a bent opening the cube of its corners.
[[nodiscard]] std::vector<Cap> find_caps(const mesh::Surface& surface, const std::vector<FaceId>& faces,
                                         double flat);

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
