// SPDX-License-Identifier: GPL-3.0-or-later
// Points that a cut made are taken out again where the surface is straight across it. Private to prepare/.
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/repair/loose_faces.hpp"

namespace ridgecraft::prepare {

/// A point on the way from one point to another one.
struct Between {
  std::uint32_t point = 0;
  std::uint32_t to = 0;  ///< its neighbour, that may take its place
};

/// Merges each of the points with its neighbour where that keeps the surface a surface and every face in its
/// plane; the others stay. O(n log n).
void take_out(mesh::LooseFaces& faces, const std::vector<Between>& points);

}  // namespace ridgecraft::prepare
