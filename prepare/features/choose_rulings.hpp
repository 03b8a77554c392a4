// SPDX-License-Identifier: GPL-3.0-or-later
// Which lines of a ruled strip stay. Private to prepare/.
#pragma once

#include <cstddef>
#include <vector>

#include "mesh/model/surface.hpp"
#include "prepare/panels/ruled_strips.hpp"

namespace ridgecraft::prepare {

/// mm all.
struct RulingRules {
  double short_edge_mm = 0.0;  ///< narrower faces are what lines go for
  double largest_mm = 0.0;     ///< how far the surface may move
  double flat_mm = 0.0;        ///< how far the corners of a face may be from one plane
  bool rolled = false;         ///< the strip is rolled as it is
};

struct ChosenRulings {
  std::vector<std::size_t> gone;  ///< lines that go, ascending; none where the strip is wide enough as it is
  double narrowest = 0.0;         ///< width of its narrowest face before
};

/// What stays costs least: each face the square of how far the surface moves there, as a share of a quarter
/// of what it may move, and the square of the short edge by its width; faces narrower than that cost more. A
/// round strip is cut into equal shares where its number of faces allows that. O(n) for strips of n lines and
/// few tiers, as no face becomes much wider than the short edge.
[[nodiscard]] ChosenRulings choose_rulings(const mesh::Surface& surface, const RuledStrip& strip,
                                           const RulingRules& rules);

}  // namespace ridgecraft::prepare
