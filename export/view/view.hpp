// SPDX-License-Identifier: GPL-3.0-or-later
// What is seen of a scene, as areas and lines: nothing hidden is left in it, so they can be drawn in any
// order.
#pragma once

#include <cstdint>
#include <vector>

#include "base/context.hpp"
#include "base/vector.hpp"
#include "export/view/camera.hpp"
#include "export/view/scene.hpp"

namespace ridgecraft::export_ {

/// What is seen of a flat region. Areas don't overlap, but for rounding to a millionth of the scene's size.
struct VisibleArea {
  std::uint32_t region = 0;
  FaceId face;          ///< one of the region's
  bool inside = false;  ///< the side without print
  /// Closed, without holes of their own: where there is a hole, a slit leads to it.
  std::vector<std::vector<Vec2>> outlines;
};

struct VisibleLine {
  EdgeId edge;
  Vec2 a;
  Vec2 b;
  bool outline = false;  ///< behind it is something else, or nothing
};

struct View {
  std::vector<VisibleArea> areas;  ///< by region
  std::vector<VisibleLine> lines;  ///< by edge
};

/// Areas are what is left of a region when all faces that lie before it are taken away; which of two faces
/// lies before the other is asked at the middle of where they overlap, so faces that run through each other
/// are drawn as if one lay before the other. Areas narrower than `smallest` and shorter lines are left out;
/// the unit is that of the scene. Deterministic. O(n log n + pairs of faces that overlap). Throws
/// Error(interrupted), Error(out_of_time).
[[nodiscard]] View look_at(const Scene& scene, const Camera& camera, double smallest, const Context& context);

}  // namespace ridgecraft::export_
