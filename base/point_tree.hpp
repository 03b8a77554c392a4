// SPDX-License-Identifier: GPL-3.0-or-later
// Points found by place, however unevenly they lie: a balanced tree of boxes.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "base/vector.hpp"

namespace ridgecraft {

/// Each node halves its points across the longest side of their box (Bentley: Multidimensional binary search
/// trees, 1975). Each point has a reach; a node knows the largest one of its points.
class PointTree {
 public:
  /// `numbers` are indices into points and reach, each once. O(n log n).
  PointTree(const std::vector<Vec3>& points, std::vector<std::uint32_t> numbers,
            const std::vector<double>& reach)
      : points_(points), numbers_(std::move(numbers)) {
    if (numbers_.empty()) {
      return;
    }
    std::size_t leaves = 1;
    while (numbers_.size() > leaves * leaf_size) {
      leaves *= 2;
    }
    first_leaf_ = leaves;
    nodes_.resize(2 * leaves);
    build(1, 0, numbers_.size(), reach);
  }

  /// Calls visit(number) for the points of all leaves that enter(box, largest reach) lets in, those near
  /// `from` first; what enter() says may change on the way.
  template <class Enter, class Visit>
  void search(Vec3 from, Enter enter, Visit visit) const {
    std::array<std::size_t, 2 * most_levels> open{};
    std::size_t count = 0;
    if (!numbers_.empty()) {
      open[count++] = 1;
    }
    while (count > 0) {
      const std::size_t at = open[--count];
      const Node& node = nodes_[at];
      if (!enter(node.box, node.reach)) {
        continue;
      }
      if (at >= first_leaf_) {
        for (std::size_t i = node.first; i < node.last; ++i) {
          visit(numbers_[i]);
        }
        continue;
      }
      const bool right_first =
          squared_distance(from, nodes_[2 * at + 1].box) < squared_distance(from, nodes_[2 * at].box);
      open[count++] = right_first ? 2 * at : 2 * at + 1;
      open[count++] = right_first ? 2 * at + 1 : 2 * at;
    }
  }

  /// Of a point from a box, 0 inside.
  static double squared_distance(Vec3 p, const Box3& box) {
    const Vec3 d{std::max({box.low.x - p.x, p.x - box.high.x, 0.0}),
                 std::max({box.low.y - p.y, p.y - box.high.y, 0.0}),
                 std::max({box.low.z - p.z, p.z - box.high.z, 0.0})};
    return dot(d, d);
  }

 private:
  static constexpr std::size_t leaf_size = 8;
  static constexpr std::size_t most_levels = 32;  ///< numbers have 32 bits
  struct Node {
    Box3 box;
    double reach = 0.0;
    std::size_t first = 0;
    std::size_t last = 0;
  };

  void build(std::size_t at, std::size_t first, std::size_t last, const std::vector<double>& reach) {
    Node& node = nodes_[at];
    node.first = first;
    node.last = last;
    for (std::size_t i = first; i < last; ++i) {
      node.box.add(points_[numbers_[i]]);
      node.reach = std::max(node.reach, reach[numbers_[i]]);
    }
    if (at >= first_leaf_) {
      return;
    }
    const Vec3 size = node.box.size();
    const auto by = [&](auto coordinate) {
      std::nth_element(numbers_.begin() + static_cast<std::ptrdiff_t>(first),
                       numbers_.begin() + static_cast<std::ptrdiff_t>(first + (last - first) / 2),
                       numbers_.begin() + static_cast<std::ptrdiff_t>(last),
                       [&](std::uint32_t a, std::uint32_t b) {
                         const double p = coordinate(points_[a]);
                         const double q = coordinate(points_[b]);
                         return p < q || (!(q < p) && a < b);
                       });
    };
    if (size.x >= size.y && size.x >= size.z) {
      by([](Vec3 p) { return p.x; });
    } else if (size.y >= size.z) {
      by([](Vec3 p) { return p.y; });
    } else {
      by([](Vec3 p) { return p.z; });
    }
    const std::size_t middle = first + (last - first) / 2;
    build(2 * at, first, middle, reach);
    build(2 * at + 1, middle, last, reach);
  }

  const std::vector<Vec3>& points_;
  std::vector<std::uint32_t> numbers_;
  std::vector<Node> nodes_;  ///< node i has the children 2 i and 2 i + 1; the root is 1
  std::size_t first_leaf_ = 1;
};

}  // namespace ridgecraft
