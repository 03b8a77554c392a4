// SPDX-License-Identifier: GPL-3.0-or-later
// Points on borders, each with a reach, to be found by place. Private to mesh/.
#pragma once

#include <cstdint>
#include <vector>

#include "base/box_tree.hpp"
#include "base/vector.hpp"

namespace ridgecraft::mesh {

/// Where companions of a point and points on an edge are looked up. O(n log n) to build.
struct BorderPoints {
  /// `numbers`: those of the list's points that lie on borders; `reach_of`: of each point of the list.
  BorderPoints(const std::vector<Vec3>& list, const std::vector<std::uint32_t>& numbers,
               const std::vector<double>& reach_of)
      : tree(
            numbers.size(),
            [&](std::uint32_t i) {
              return Box3{list[numbers[i]], list[numbers[i]]};
            },
            [&](std::uint32_t i) { return list[numbers[i]]; }),
        reach(tree.largest_below([&](std::uint32_t i) { return reach_of[numbers[i]]; })) {
    points.reserve(numbers.size());
    for (const std::uint32_t i : tree.order()) {
      points.push_back(numbers[i]);
    }
  }

  BoxTree<Box3> tree;
  std::vector<double> reach;          ///< per node of the tree, the largest of its points
  std::vector<std::uint32_t> points;  ///< numbers in the list, in the order of the tree
};

}  // namespace ridgecraft::mesh
