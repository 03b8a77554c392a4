// SPDX-License-Identifier: GPL-3.0-or-later
// Faces that are larger than the paper become smaller ones; faces that are too narrow are counted.
#pragma once

#include "mesh/context.hpp"
#include "mesh/model.hpp"
#include "mesh/panels.hpp"

namespace ridgecraft::mesh {

/// Can a triangle with these sides be laid into the rectangle, turned as need be? Turns are tried degree by
/// degree, so the answer may be no for a triangle that only just fits.
[[nodiscard]] bool fits_rectangle(double a, double b, double c, Vec2 rectangle);

/// Divides the longest edge of each face that doesn't fit, with the face beyond it, until all fit. Throws
/// Error(no_nets) where that takes more than a million faces. O(n) for each halving.
void subdivide(Model& model, Vec2 largest_face_mm, const Context& context);

/// Width that scissors or a knife can cut at all, mm.
inline constexpr double narrow_mm = 0.05;
/// Below this width, mm, a face is less than the thinnest line that a printer draws: not even the note helps.
inline constexpr double nothing_mm = 0.005;

/// Faces whose panel is nowhere as wide as `width`.
[[nodiscard]] std::size_t count_narrow_faces(const Surface& surface, const Panels& panels, double width);

}  // namespace ridgecraft::mesh
