// SPDX-License-Identifier: GPL-3.0-or-later
// How a picture lies on a flat region. Private to mesh/.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "mesh/foundation/vector.hpp"
#include "mesh/panels/plane_frame.hpp"
#include "mesh/repair/loose_faces.hpp"

namespace ridgecraft::mesh {

/// origin + (across, up) applied to a place in the region's frame: a place in the picture.
struct PictureMap {
  Vec2 origin;
  Vec2 across;
  Vec2 up;
  [[nodiscard]] Vec2 operator()(Vec2 p) const { return origin + p.x * across + p.y * up; }
};

/// The one affine map that lays the picture on all these faces; none where there isn't one, or no picture.
/// O(faces).
[[nodiscard]] std::optional<PictureMap> picture_map(const LooseFaces& loose,
                                                    const std::vector<std::uint32_t>& faces,
                                                    const PlaneFrame& frame);

}  // namespace ridgecraft::mesh
