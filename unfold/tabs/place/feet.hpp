// SPDX-License-Identifier: GPL-3.0-or-later
// Where bodies stand on others: flat openings that lie on another body's face.
#pragma once

#include <vector>

#include "base/context.hpp"
#include "base/id.hpp"
#include "mesh/model/surface.hpp"

namespace ridgecraft::unfold {

/// A side of a foot: a border edge that lies on a face of another component.
struct FootSide {
  CornerId side;
  /// The whole opening, laid flat over the edge in the frame of tab shapes: where a tab lies when it is
  /// folded inwards. The edge is its first side.
  std::vector<Vec2> opening;
};

/// Openings that are flat and lie on parallel faces of other components, none farther from them than
/// mesh::touching_mm; of their sides those whose middle does, and whose face rises from there by 30 degrees:
/// a sheet that lies on a face has none. Openings of more than 1000 sides have none either. O(n log n), and
/// the square of an opening's sides. Throws Error(interrupted).
[[nodiscard]] std::vector<FootSide> find_feet(const mesh::Surface& surface, const Context& context);

}  // namespace ridgecraft::unfold
