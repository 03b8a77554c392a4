// SPDX-License-Identifier: GPL-3.0-or-later
// A model's pictures, resampled dot by dot to where its faces lie on the page.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/context.hpp"
#include "export/paint/cells.hpp"
#include "export/sheet/drawing.hpp"
#include "mesh/look/look.hpp"

namespace ridgecraft::export_ {

/// What becomes of each value of each channel when it is printed.
using Shade = std::array<std::uint8_t, 256>;

[[nodiscard]] inline mesh::Rgb shaded(const Shade& shade, const mesh::Rgb& colour) {
  return {shade[colour[0]], shade[colour[1]], shade[colour[2]]};
}

/// Where a place of a cell lies on the surface. Beyond the face, in rims and strips, it is the nearest place
/// of the face.
[[nodiscard]] Vec3 place_on_surface(const mesh::Surface& surface, const Cell& cell, Vec2 on_page);

/// One picture of these cells, with the colours of the original surface's nearest places. `shade` has the
/// last word on each. O(dots) for faces that lie on one original face, O(dots x log n) for others;
/// neighbouring dots mostly lie on one original face, which makes these quick, too.
[[nodiscard]] Image picture_of(const std::vector<const Cell*>& cells, const mesh::Surface& surface,
                               const mesh::Look& look, double dots_per_inch, const Shade& shade,
                               const Context& context);

}  // namespace ridgecraft::export_
