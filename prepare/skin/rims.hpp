// SPDX-License-Identifier: GPL-3.0-or-later
// Flat openings of bodies that could be closed. Private to prepare/.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mesh/model/surface.hpp"

namespace ridgecraft::prepare {

/// One opening and what closes it: triangles that run along it against the surface, as a face there would.
struct Cap {
  std::vector<std::array<VertexId, 3>> triangles;
};

/// The caps of a component, one for each of its openings; empty where an opening isn't flat, crosses itself,
/// or where the component with its caps would hold next to nothing: a sheet. `flat`: how far points of an
/// opening may be from its plane. `faces`: those of the component. O(n log n).
[[nodiscard]] std::vector<Cap> find_caps(const mesh::Surface& surface, const std::vector<FaceId>& faces,
                                         double flat);

}  // namespace ridgecraft::prepare
