// SPDX-License-Identifier: GPL-3.0-or-later
// Shapes made in code, for tests: oriented outward, welded.
#pragma once

#include <array>
#include <vector>

#include "mesh/model/surface.hpp"

namespace ridgecraft::test {

/// Cube of side 1 with a corner at the origin: 12 faces.
[[nodiscard]] mesh::Surface cube();
/// Regular tetrahedron of edge sqrt(2).
[[nodiscard]] mesh::Surface tetrahedron();
/// Unit cubes at integer places; each outer square divided k by k; squares between two cubes are left out.
[[nodiscard]] mesh::Surface voxels(const std::vector<std::array<int, 3>>& cells, int k = 1);
/// Profile (r, z) turned around the z axis in `steps` steps; points with r = 0 are poles. A profile that runs
/// upwards on the outside gives outward faces. A profile that doesn't begin and end at r = 0 leaves the
/// surface open, unless its last point equals its first (torus).
[[nodiscard]] mesh::Surface revolve(const std::vector<Vec2>& profile, int steps);
/// Longitude-latitude sphere of radius 1 with 2 * longitudes * (latitudes - 1) faces.
[[nodiscard]] mesh::Surface sphere(int longitudes, int latitudes);
/// The same surface with every coordinate multiplied.
[[nodiscard]] mesh::Surface scaled(const mesh::Surface& surface, double factor);

}  // namespace ridgecraft::test
