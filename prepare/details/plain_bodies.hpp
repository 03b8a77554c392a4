// SPDX-License-Identifier: GPL-3.0-or-later
// Blocks in the place of small bodies that are too busy to be folded. Private to prepare/.
#pragma once

#include "base/context.hpp"
#include "mesh/model/model.hpp"
#include "prepare/prepared/ready_report.hpp"

namespace ridgecraft::prepare {

/// Lengths in the unit of the surface.
struct PlainLimits {
  double short_edge = 0.0;    ///< shorter edges are hard to fold
  double shallow = 0.0;       ///< lower bodies stay as they are
  double largest_move = 0.0;  ///< how far a block may be from what it stands for, both ways
  double busy = 0.0;          ///< the share of the length of its folded edges that are short, in a busy body
  double hidden_fold_angle = 0.0;  ///< edges that bend less aren't folded (radians)
};

/// What a designer does with a barrel, a window frame or a lamp of a small model: busy components that are
/// short beside the model become prisms (plain_prism.hpp), where these have no more than half as many short
/// edges, look like them from all sides and are nowhere farther from them than allowed. Collapses, edge by
/// edge, would leave crumpled paper of them. None is made where blocks would have more than two fifths of the
/// model's area. A block's sides have the material and the object of what looks the same way. Tells how many,
/// and how far they are from what they stand for, in the unit of the surface. O(n log n), and s^2 for
/// outlines of s sides.
[[nodiscard]] PlainBodies make_plain(mesh::Model& model, const PlainLimits& limits, const Context& context);

}  // namespace ridgecraft::prepare
