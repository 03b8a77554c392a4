// SPDX-License-Identifier: GPL-3.0-or-later
// How a picture lies on a flat region. Private to prepare/.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "base/plane_frame.hpp"
#include "base/vector.hpp"
#include "mesh/repair/loose_faces.hpp"

namespace ridgecraft::prepare {

/// origin + (across, up) applied to a place in the region's frame: a place in the picture.
struct PictureMap {
  Vec2 origin;
  Vec2 across;
  Vec2 up;
  [[nodiscard]] Vec2 operator()(Vec2 p) const { return origin + p.x * across + p.y * up; }
};

/// The one affine map that lays the picture on all these faces; none where there isn't one, or no picture.
/// O(faces).
[[nodiscard]] std::optional<PictureMap> picture_map(const mesh::LooseFaces& loose,
                                                    const std::vector<std::uint32_t>& faces,
                                                    const PlaneFrame& frame);

}  // namespace ridgecraft::prepare
