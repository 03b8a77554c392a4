// SPDX-License-Identifier: GPL-3.0-or-later
// Things found by place, however unevenly they lie: a balanced tree of boxes, in the plane and in space.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/vector.hpp"

namespace ridgecraft {

/// Squared distance of a point from a box, 0 inside.
[[nodiscard]] inline double squared_distance(Vec3 p, const Box3& box) {
  const auto outside = [](double low, double x, double high) {
    return std::max(std::max(low - x, x - high), 0.0);
  };
  const Vec3 d{outside(box.low.x, p.x, box.high.x), outside(box.low.y, p.y, box.high.y),
               outside(box.low.z, p.z, box.high.z)};
  return dot(d, d);
}

/// Each node halves its items across the longest side of the box of their centres (Bentley: Multidimensional
/// binary search trees, 1975). It knows boxes only: what an item is, and what is asked of it, is up to
/// whoever holds the tree. `Box` is Box2 or Box3.
///
/// Three questions in the program have containers of their own: all pairs of a list that is asked once are
/// found faster along a curve (near_boxes.hpp), the many boxes of one size in a net by a grid (box_grid.hpp),
/// and faces that move while they are searched by circles (unfold/search/circle_tree.hpp). The reasons are in
/// docs/design/architecture.md, "Written here, and why".
template <class Box>
class BoxTree {
 public:
  using Point = decltype(Box::low);

  /// Items 0 .. count - 1: box_of(i) must not be empty, centre_of(i) is any point in it. Equal centres are
  /// told apart by their numbers, so one list makes one tree on every machine. O(n log n).
  template <class BoxOf, class CentreOf>
  BoxTree(std::size_t count, const BoxOf& box_of, const CentreOf& centre_of) : order_(count) {
    if (count == 0) {
      return;
    }
    nodes_.reserve(count / 2 + 2);
    std::vector<Item> items(count);
    for (std::uint32_t i = 0; i < count; ++i) {
      items[i] = {centre_of(i), i};
    }
    build(0, static_cast<std::uint32_t>(count), box_of, items);
  }

  /// The items in the order of the leaves: whoever keeps them in this order finds those of a leaf side by
  /// side.
  [[nodiscard]] const std::vector<std::uint32_t>& order() const { return order_; }
  [[nodiscard]] const Box& box(std::uint32_t node) const { return nodes_[node].box; }

  /// Per node, the largest of the values of its items; value_of(i) isn't negative. O(n).
  template <class ValueOf>
  [[nodiscard]] std::vector<double> largest_below(const ValueOf& value_of) const {
    std::vector<double> largest(nodes_.size(), 0.0);
    // Children have higher numbers than their parents.
    for (std::size_t at = nodes_.size(); at-- > 0;) {
      const Node& node = nodes_[at];
      if (node.count == 0) {
        largest[at] = std::max(largest[at + 1], largest[node.first]);
      }
      for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
        largest[at] = std::max(largest[at], value_of(order_[i]));
      }
    }
    return largest;
  }

  /// Calls visit(place) for the places in order() of all leaves that enter(node) lets in, in that order.
  template <class Enter, class Visit>
  void search(Enter enter, Visit visit) const {
    if (nodes_.empty() || !enter(0U)) {
      return;
    }
    std::array<std::uint32_t, most_open> open;  // let in, but not looked at
    std::size_t count = 0;
    open[count++] = 0;
    while (count > 0) {
      std::uint32_t at = open[--count];
      while (nodes_[at].count == 0) {
        const std::uint32_t second = nodes_[at].first;
        const bool enters_second = enter(second);
        if (enter(at + 1)) {
          open[count] = second;
          count += enters_second ? 1U : 0U;
          at = at + 1;
        } else if (enters_second) {
          at = second;
        } else {
          break;
        }
      }
      const Node& leaf = nodes_[at];
      for (std::uint32_t i = leaf.first; i < leaf.first + leaf.count; ++i) {
        visit(i);
      }
    }
  }

  /// The same, what is nearer to `from` first and in order() where two are equally near. `found` is what the
  /// search has come to: enter(found, node, squared distance of its box) may refuse what it would have let in
  /// before, visit(found, place) changes it, and it is returned. It is handed round, not captured, so that it
  /// stays in registers: a tenth of the time of a search.
  template <class Found, class Enter, class Visit>
  Found nearest_first(Point from, Found found, Enter enter, Visit visit) const {
    if (nodes_.empty()) {
      return found;
    }
    std::array<std::uint32_t, most_open> open;
    std::array<double, most_open> open_distance;  // apart: read and written together, both would be slower
    std::size_t count = 0;
    std::uint32_t at = 0;
    double distance = squared_distance(from, nodes_[0].box);
    while (true) {
      const Node& node = nodes_[at];
      if (enter(found, at, distance)) {
        if (node.count == 0) {
          const double left = squared_distance(from, nodes_[at + 1].box);
          const double right = squared_distance(from, nodes_[node.first].box);
          const bool left_first = left <= right;
          open[count] = left_first ? node.first : at + 1;
          open_distance[count++] = left_first ? right : left;
          at = left_first ? at + 1 : node.first;
          distance = left_first ? left : right;
          continue;
        }
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
          visit(found, i);
        }
      }
      if (count == 0) {
        return found;
      }
      at = open[--count];
      distance = open_distance[count];
    }
  }

 private:
  static constexpr std::uint32_t leaf_size = 4;
  static constexpr std::size_t most_open = 64;  ///< numbers have 32 bits, and items are halved
  struct Node {
    Box box;
    std::uint32_t first = 0;  ///< leaf: into order_; else its second child (the first one follows it)
    std::uint32_t count = 0;  ///< items of a leaf; 0 for any other node
  };

  /// With its centre, so that nothing is looked up all over memory while items are halved.
  struct Item {
    Point centre;
    std::uint32_t number = 0;
  };

  /// Puts the lower half before the upper one along the longest side, which is chosen once and not in each
  /// comparison.
  static void halve(std::vector<Item>& items, std::uint32_t first, std::uint32_t middle, std::uint32_t last,
                    Vec2 size) {
    size.x >= size.y ? halve_along(items, first, middle, last, [](Vec2 p) { return p.x; })
                     : halve_along(items, first, middle, last, [](Vec2 p) { return p.y; });
  }
  static void halve(std::vector<Item>& items, std::uint32_t first, std::uint32_t middle, std::uint32_t last,
                    Vec3 size) {
    if (size.x >= size.y && size.x >= size.z) {
      halve_along(items, first, middle, last, [](Vec3 p) { return p.x; });
    } else if (size.y >= size.z) {
      halve_along(items, first, middle, last, [](Vec3 p) { return p.y; });
    } else {
      halve_along(items, first, middle, last, [](Vec3 p) { return p.z; });
    }
  }
  template <class Along>
  static void halve_along(std::vector<Item>& items, std::uint32_t first, std::uint32_t middle,
                          std::uint32_t last, const Along& along) {
    std::nth_element(items.begin() + first, items.begin() + middle, items.begin() + last,
                     [&](const Item& a, const Item& b) {
                       const double p = along(a.centre);
                       const double q = along(b.centre);
                       return p < q || (!(q < p) && a.number < b.number);
                     });
  }
  static void add(Box& box, const Box& other) {
    box.add(other.low);
    box.add(other.high);
  }

  template <class BoxOf>
  std::uint32_t build(std::uint32_t first, std::uint32_t last, const BoxOf& box_of,
                      std::vector<Item>& items) {
    const auto number = static_cast<std::uint32_t>(nodes_.size());
    nodes_.emplace_back();
    if (last - first <= leaf_size) {
      for (std::uint32_t i = first; i < last; ++i) {
        order_[i] = items[i].number;
      }
      // Halving leaves them in an order that differs between standard libraries.
      std::sort(order_.begin() + first, order_.begin() + last);
      for (std::uint32_t i = first; i < last; ++i) {
        add(nodes_[number].box, box_of(order_[i]));
      }
      nodes_[number].first = first;
      nodes_[number].count = last - first;
      return number;
    }
    Box middles;
    for (std::uint32_t i = first; i < last; ++i) {
      middles.add(items[i].centre);
    }
    const std::uint32_t middle = first + (last - first) / 2;
    halve(items, first, middle, last, middles.size());
    build(first, middle, box_of, items);
    const std::uint32_t second = build(middle, last, box_of, items);
    nodes_[number].first = second;
    add(nodes_[number].box, nodes_[number + 1].box);
    add(nodes_[number].box, nodes_[second].box);
    return number;
  }

  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace ridgecraft
