// SPDX-License-Identifier: GPL-3.0-or-later
// Pieces from triangles alone: layout looks at nothing else but faces, tabs and parts.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/context.hpp"
#include "base/random.hpp"
#include "unfold/net/nets.hpp"

namespace ridgecraft::test {

class PlainPieces {
 public:
  void add(const std::vector<std::array<Vec2, 3>>& triangles, std::uint32_t part = 0);
  /// A fan over corners that all see the first one.
  void add_fan(const std::vector<Vec2>& corners, std::uint32_t part = 0);
  /// Each is its lower left and its upper right corner.
  void add_boxes(const std::vector<std::array<double, 4>>& boxes, std::uint32_t part = 0);
  /// A triangle of paper beside the first side of the face that was added last.
  void add_tab();
  [[nodiscard]] const unfold::Nets& nets() const { return nets_; }

 private:
  unfold::Nets nets_;
};

/// Of all faces, mm^2.
[[nodiscard]] double area_of(const unfold::Nets& nets);

/// A star-shaped polygon round the origin, which is its first corner.
[[nodiscard]] std::vector<Vec2> blob(Random& random, double size);

}  // namespace ridgecraft::test
