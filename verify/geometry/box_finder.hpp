// SPDX-License-Identifier: GPL-3.0-or-later
// Finds the boxes of the plane near a box.
#pragma once

#include <cstdint>
#include <vector>

#include "base/box_tree.hpp"
#include "base/vector.hpp"

namespace ridgecraft::verify {

/// Built once for a set of boxes, none empty, in O(n log n); O(log n) per query and box found when boxes are
/// spread.
class BoxFinder {
 public:
  explicit BoxFinder(const std::vector<Box2>& boxes)
      : tree_(
            boxes.size(), [&](std::uint32_t i) { return boxes[i]; },
            [&](std::uint32_t i) { return 0.5 * (boxes[i].low + boxes[i].high); }) {
    boxes_.reserve(boxes.size());
    for (const std::uint32_t i : tree_.order()) {
      boxes_.push_back(boxes[i]);
    }
  }

  /// Calls visit(number) for each box that has more than a border point in common with this one, in no
  /// special order.
  template <typename Visit>
  void for_each_overlapping(const Box2& box, Visit&& visit) const {
    tree_.search([&](std::uint32_t node) { return overlap(tree_.box(node), box); },
                 [&](std::uint32_t i) {
                   if (overlap(boxes_[i], box)) {
                     visit(tree_.order()[i]);
                   }
                 });
  }

 private:
  static bool overlap(const Box2& a, const Box2& b) {
    return a.low.x < b.high.x && b.low.x < a.high.x && a.low.y < b.high.y && b.low.y < a.high.y;
  }

  BoxTree<Box2> tree_;
  std::vector<Box2> boxes_;  ///< in the order of the leaves
};

}  // namespace ridgecraft::verify
