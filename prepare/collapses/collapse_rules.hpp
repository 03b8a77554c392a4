// SPDX-License-Identifier: GPL-3.0-or-later
// What guides simplification. Private to prepare/.
#pragma once

#include "mesh/model/surface_distance.hpp"

namespace ridgecraft::prepare {

/// What guides and limits the collapses besides the quadric error.
struct CollapseRules {
  /// The error is multiplied by (length / short_edge)^power: with a power above 0 short edges go first.
  double short_edge = 1.0;
  double power = 0.0;
  /// Where given, the surface may not leave this field around the original one, nor move farther from any
  /// part of the original than largest_deviation.
  mesh::NearField* field = nullptr;
  double largest_deviation = 0.0;
};

}  // namespace ridgecraft::prepare
