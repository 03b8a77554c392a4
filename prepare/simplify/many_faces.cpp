// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/simplify/many_faces.hpp"

#include <algorithm>
#include <numbers>

namespace ridgecraft::prepare {
namespace {

constexpr double coarse = 3.0;
/// A surface of equilateral triangles with the short edge has so many faces.
double faces_of_short_edges(const mesh::Surface& surface, double short_edge_mm) {
  const double small_face = 0.25 * std::numbers::sqrt3 * short_edge_mm * short_edge_mm;
  return std::clamp(mesh::total_area(surface) / small_face, double{fewest_faces}, 1e9);
}

}  // namespace

std::size_t careless_faces(const mesh::Surface& surface, double short_edge_mm) {
  return static_cast<std::size_t>(coarse * faces_of_short_edges(surface, short_edge_mm));
}

}  // namespace ridgecraft::prepare
