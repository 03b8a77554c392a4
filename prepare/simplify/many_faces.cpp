// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/simplify/many_faces.hpp"

#include <algorithm>
#include <numbers>

#include "prepare/prepared/panels.hpp"

namespace ridgecraft::prepare {
namespace {

constexpr double coarse = 3.0;
/// What is made of walls has so many triangles in each flat face on average.
constexpr double of_walls = 3.0;
/// It may have so many times as many triangles.
constexpr double share_of_walls = 1.35;

/// A surface of equilateral triangles with the short edge has so many faces.
double faces_of_short_edges(const mesh::Surface& surface, double short_edge_mm) {
  const double small_face = 0.25 * std::numbers::sqrt3 * short_edge_mm * short_edge_mm;
  return std::clamp(mesh::total_area(surface) / small_face, double{fewest_faces}, 1e9);
}

}  // namespace

std::size_t most_triangles(const mesh::Surface& surface, const SimplifyOptions& options) {
  const std::size_t faces = surface.face_count();
  if (faces <= options.most_faces) {
    return options.most_faces;
  }
  const auto most = static_cast<std::size_t>(share_of_walls * static_cast<double>(options.most_faces));
  const std::size_t flat = find_panels(surface).count();
  if (static_cast<double>(faces) < of_walls * static_cast<double>(flat)) {
    return options.most_faces;
  }
  return std::clamp(options.most_flat_faces * faces / flat, options.most_faces, most);
}

std::size_t careless_faces(const mesh::Surface& surface, double short_edge_mm) {
  return static_cast<std::size_t>(coarse * faces_of_short_edges(surface, short_edge_mm));
}

}  // namespace ridgecraft::prepare
