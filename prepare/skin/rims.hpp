// SPDX-License-Identifier: GPL-3.0-or-later
// Openings of bodies that could be closed. Private to prepare/.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

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

}  // namespace ridgecraft::prepare
