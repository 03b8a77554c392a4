// SPDX-License-Identifier: GPL-3.0-or-later
// Finds the boxes near a box: a binary tree over boxes, halved at the median centre of the longer direction.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/vector.hpp"

namespace ridgecraft::verify {

/// Built once for a set of boxes in O(n log n); O(log n) per query and box found when boxes are spread.
class BoxTree {
 public:
  explicit BoxTree(std::vector<Box2> boxes);

  /// Calls visit(number) for each box that has more than a border point in common with this one, in no
  /// special order.
  template <typename Visit>
  void for_each_overlapping(const Box2& box, Visit&& visit) const {
    if (!nodes_.empty()) {
      descend(0, box, visit);
    }
  }

 private:
  struct Node {
    Box2 box;
    std::uint32_t begin, end;  ///< its range of order_
    std::uint32_t right;       ///< 0 for a leaf; the left child follows its parent
  };

  static bool overlap(const Box2& a, const Box2& b) {
    return a.low.x < b.high.x && b.low.x < a.high.x && a.low.y < b.high.y && b.low.y < a.high.y;
  }

  template <typename Visit>
  void descend(std::uint32_t at, const Box2& box, Visit& visit) const {
    const Node& node = nodes_[at];
    if (!overlap(node.box, box)) {
      return;
    }
    if (node.right != 0) {
      descend(at + 1, box, visit);
      descend(node.right, box, visit);
      return;
    }
    for (std::uint32_t i = node.begin; i < node.end; ++i) {
      if (overlap(boxes_[order_[i]], box)) {
        visit(order_[i]);
      }
    }
  }

  std::uint32_t build(std::uint32_t begin, std::uint32_t end);

  std::vector<Box2> boxes_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace ridgecraft::verify
