// SPDX-License-Identifier: GPL-3.0-or-later
// Strips of narrow flat faces side by side, such as the sides of a column or the inside of an arch. Private
// to prepare/.
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/model/surface.hpp"
#include "mesh/repair/loose_faces.hpp"
#include "prepare/panels/regions.hpp"

namespace ridgecraft::prepare {

/// Straight sides end to end across a strip: a ruling of a cylinder or cone, or several where rings of faces
/// stand on each other. Its points in order; a tip is a point of every line of its strip.
struct RulingLine {
  std::vector<std::uint32_t> points;
  /// The largest fold along it, radians, 0 where it is the surface's border.
  double fold = 0.0;
};

/// Lines side by side, equally many points on each, and the regions between neighbours: each of four sides,
/// or of three at a tip.
struct RuledStrip {
  bool round = false;  ///< the last line is beside the first one
  bool loops = false;  ///< each line is closed: a ring around something
  std::vector<RulingLine> lines;
  /// regions[i][t] lies between line i and line i + 1 (of a round strip the first one after the last), from
  /// point t to point t + 1 (of loops the first one after the last).
  std::vector<std::vector<std::uint32_t>> regions;

  /// How many regions lie between two lines.
  [[nodiscard]] std::size_t tiers() const { return regions.empty() ? 0 : regions.front().size(); }
};

/// All strips with a line that could go: no other side ends at its points, but for tips, so that the regions
/// beside it would become one, and what it ends at would lose a corner. The first and the last line of a
/// strip that isn't round can't go. A region may be part of two strips that run across each other. In the
/// order of their first lines' edges. O(n).
[[nodiscard]] std::vector<RuledStrip> ruled_strips(const mesh::Surface& surface, const PanelRegions& regions,
                                                   const mesh::LooseFaces& loose);

}  // namespace ridgecraft::prepare
