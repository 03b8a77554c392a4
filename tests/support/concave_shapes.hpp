// SPDX-License-Identifier: GPL-3.0-or-later
// The shapes that a segmentation must get right, made in code.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "mesh/model/surface.hpp"

namespace ridgecraft::test {

/// Straight pieces of a profile divided to about `step`.
[[nodiscard]] std::vector<Vec2> divided(const std::vector<Vec2>& profile, double step = 0.1);
/// A profile turned around z with its straight pieces divided to about 0.1.
[[nodiscard]] mesh::Surface turned(const std::vector<Vec2>& profile, int steps = 48);
/// Outer surface of unit spheres at these heights, meeting in common rings.
[[nodiscard]] mesh::Surface sphere_chain(const std::vector<double>& heights, int steps = 64);
/// A cup with a rounded rim that goes up and down three times by a twentieth of its radius.
[[nodiscard]] mesh::Surface uneven_cup();
/// Two unit balls at z = -2 and 2, joined by a neck of radius 0.25.
[[nodiscard]] mesh::Surface dumbbell();
[[nodiscard]] mesh::Surface torus(double ring, double tube, int tube_steps = 32, int ring_steps = 64);
/// Sphere whose radius depends on the direction.
[[nodiscard]] mesh::Surface star_shaped(const std::function<double(Vec3)>& radius, int longitudes,
                                        int latitudes);
/// Corners of an icosahedron, as unit vectors.
[[nodiscard]] std::vector<Vec3> icosahedron_corners();
[[nodiscard]] mesh::Surface spiked_sphere(std::size_t spikes, double width, int longitudes, int latitudes);
/// Squares of side 1 and the given thickness where `solid` says so, each 2 by 2 times divided, of a 10 by 10
/// grid.
[[nodiscard]] mesh::Surface plate(double thickness, const std::function<bool(int, int)>& solid);

/// The same surface with its points mapped.
[[nodiscard]] mesh::Surface mapped(const mesh::Surface& surface, const std::function<Vec3(Vec3)>& map);
/// Several surfaces as one.
[[nodiscard]] mesh::Surface together(const std::vector<mesh::Surface>& surfaces);
/// The same surface with vertices and faces in another order and the corners of faces rotated. `face_from`,
/// when given, receives the old number of each new face.
[[nodiscard]] mesh::Surface shuffled(const mesh::Surface& surface, std::uint64_t seed,
                                     std::vector<std::uint32_t>* face_from = nullptr);

}  // namespace ridgecraft::test
