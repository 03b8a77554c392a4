// SPDX-License-Identifier: GPL-3.0-or-later
// Where something opens in a flat wall or stands out of it. Private to prepare/.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "base/vector.hpp"
#include "mesh/model/model.hpp"
#include "mesh/model/surface.hpp"
#include "mesh/repair/loose_faces.hpp"
#include "prepare/walls/walls.hpp"

namespace ridgecraft::prepare {

/// A closed line of sides within a wall, as the wall's faces run.
struct WallLoop {
  std::uint32_t wall = 0;
  std::vector<CornerId> sides;  ///< of the wall's faces
  Box3 box;
  double area = 0.0;            ///< that it encloses
  double outline_extent = 0.0;  ///< largest extent of the wall's outline
  double outline_area = 0.0;    ///< that it encloses, with all that opens in it
  bool has_rims = false;        ///< some sides have nothing beyond

  /// Else it is most of what there is to see of the wall.
  [[nodiscard]] bool leaves_wall() const {
    return box.largest_extent() <= 0.5 * outline_extent || area <= 0.25 * outline_area;
  }
};

/// Those of all walls, but for each wall's outline, which is the largest of its loops. O(n log n).
[[nodiscard]] std::vector<WallLoop> loops_within(const mesh::Surface& surface, const Walls& walls);

/// Of a point from a box; 0 within it.
[[nodiscard]] double distance(const Box3& box, Vec3 p);

/// New faces, each with the face that it is like.
using Caps = std::vector<std::pair<std::array<std::uint32_t, 3>, std::size_t>>;

/// The wall goes on across the loop, by triangles that are added to `caps`; false where the loop bounds no
/// plane area.
[[nodiscard]] bool close_loop(const mesh::Surface& surface, const Walls& walls, const WallLoop& loop,
                              Caps& caps);

/// The faces that aren't `gone`, then the caps, which are of no polygon.
[[nodiscard]] mesh::LooseFaces with_caps(const mesh::LooseFaces& all, const std::vector<bool>& gone,
                                         const Caps& caps);

}  // namespace ridgecraft::prepare
