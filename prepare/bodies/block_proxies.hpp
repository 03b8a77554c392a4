// SPDX-License-Identifier: GPL-3.0-or-later
// Blocks replace small bodies that are too detailed to be folded. Private to prepare/.
#pragma once

#include "base/context.hpp"
#include "mesh/model/model.hpp"
#include "prepare/prepared/prepared.hpp"

namespace ridgecraft::prepare {

/// Lengths in the unit of the surface.
struct ProxyLimits {
  double short_edge = 0.0;    ///< shorter edges are hard to fold
  double shallow = 0.0;       ///< lower bodies stay as they are
  double largest_move = 0.0;  ///< how far a block may be from what it stands for, both ways
  double over_detailed =
      0.0;  ///< the share of the length of its folded edges that are short, in a over-detailed body
  double hidden_fold_angle = 0.0;  ///< edges that bend less aren't folded (radians)
};

/// What a designer does with a barrel, a window frame or a lamp of a small model: over-detailed components
/// that are short beside the model become prisms (fit_prism.hpp), where these have no more than half as many
/// short edges, look like them from all sides and are nowhere farther from them than allowed. Collapses, edge
/// by edge, would leave crumpled paper of them. None is made where blocks would have more than two fifths of
/// the model's area. A block's sides have the material and the object of what looks the same way. Tells how
/// many, and how far they are from what they stand for, in the unit of the surface. O(n log n), and s^2 for
/// outlines of s sides.
[[nodiscard]] BlockProxies make_block_proxies(mesh::Model& model, const ProxyLimits& limits,
                                              const Context& context);

}  // namespace ridgecraft::prepare
