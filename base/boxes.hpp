// SPDX-License-Identifier: GPL-3.0-or-later
// Axis-parallel boxes in the plane and in space, and ways to find those near a place: a grid, a balanced
// tree, all pairs that touch.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/vector.hpp"

namespace ridgecraft {

/// The smallest box around the points; empty where there are none.
[[nodiscard]] inline Box2 box_of(std::span<const Vec2> points) {
  Box2 box;
  for (const Vec2 p : points) {
    box.add(p);
  }
  return box;
}
[[nodiscard]] inline Box2 box_of(std::span<const std::vector<Vec2>> lines) {
  Box2 box;
  for (const std::vector<Vec2>& line : lines) {
    for (const Vec2 p : line) {
      box.add(p);
    }
  }
  return box;
}

/// The box grown by `margin` on all sides.
[[nodiscard]] inline Box2 grown(const Box2& box, double margin) {
  return {box.low - Vec2{margin, margin}, box.high + Vec2{margin, margin}};
}
[[nodiscard]] inline Box3 grown(const Box3& box, double margin) {
  return {box.low - Vec3{margin, margin, margin}, box.high + Vec3{margin, margin, margin}};
}

/// Do the closed boxes have a point in common?
[[nodiscard]] inline bool meet(const Box2& a, const Box2& b) {
  return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y && b.low.y <= a.high.y;
}
[[nodiscard]] inline bool meet(const Box3& a, const Box3& b) {
  return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y && b.low.y <= a.high.y &&
         a.low.z <= b.high.z && b.low.z <= a.high.z;
}

[[nodiscard]] inline Vec3 centre(const Box3& box) {
  return 0.5 * (box.low + box.high);
}

// Finds the boxes of the plane that meet a box: a uniform grid in two flat arrays, built once.

/// Boxes 0 .. n-1, each listed in all cells that it meets. Cells are about as large as the mean box, and
/// never more than a few per box, so building is O(n) and a query O(answer) for boxes of similar size.
class BoxGrid {
 public:
  explicit BoxGrid(std::vector<Box2> boxes) : boxes_(std::move(boxes)) {
    double mean = 0.0;
    for (const Box2& box : boxes_) {
      all_.add(box.low);
      all_.add(box.high);
      mean += std::max(box.size().x, box.size().y);
    }
    const double n = static_cast<double>(std::max<std::size_t>(boxes_.size(), 1));
    const Vec2 size = boxes_.empty() ? Vec2{} : all_.size();
    // Two cells per box at most: a few large and many small boxes must not make millions of cells.
    cell_ =
        std::max(mean / n, std::max(std::sqrt(size.x * size.y / (2.0 * n)), (size.x + size.y) / (2.0 * n)));
    if (!(cell_ > 0.0)) {
      cell_ = 1.0;
    }
    columns_ = static_cast<std::uint32_t>(size.x / cell_) + 1;
    rows_ = static_cast<std::uint32_t>(size.y / cell_) + 1;
    fill();
  }

  /// Calls visit(i) once for each box i that meets `query`, in an order that depends on the boxes alone.
  template <class Visit>
  void visit(const Box2& query, Visit&& visit_box) const {
    if (boxes_.empty() || !meet(query, all_)) {
      return;
    }
    const Range range = cells(query);
    for (std::uint32_t y = range.low_y; y <= range.high_y; ++y) {
      for (std::uint32_t x = range.low_x; x <= range.high_x; ++x) {
        for (std::uint32_t k = first_[y * columns_ + x]; k < first_[y * columns_ + x + 1]; ++k) {
          const std::uint32_t i = items_[k];
          const Range own = cells(boxes_[i]);
          // A box that lies in several cells of the query is visited in the first one only.
          if (x == std::max(own.low_x, range.low_x) && y == std::max(own.low_y, range.low_y) &&
              meet(boxes_[i], query)) {
            visit_box(i);
          }
        }
      }
    }
  }

 private:
  struct Range {
    std::uint32_t low_x, low_y, high_x, high_y;
  };

  [[nodiscard]] static std::uint32_t clamp(double value, std::uint32_t count) {
    return value <= 0.0 ? 0 : static_cast<std::uint32_t>(std::min(static_cast<double>(count - 1), value));
  }
  [[nodiscard]] Range cells(const Box2& box) const {
    const Vec2 low = (box.low - all_.low) / cell_;
    const Vec2 high = (box.high - all_.low) / cell_;
    return {clamp(low.x, columns_), clamp(low.y, rows_), clamp(high.x, columns_), clamp(high.y, rows_)};
  }
  void fill() {
    first_.assign(std::size_t{columns_} * rows_ + 1, 0);
    each_cell([this](std::uint32_t cell, std::uint32_t) { ++first_[cell + 1]; });
    for (std::size_t i = 1; i < first_.size(); ++i) {
      first_[i] += first_[i - 1];
    }
    items_.resize(first_.back());
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    each_cell([this, &next](std::uint32_t cell, std::uint32_t i) { items_[next[cell]++] = i; });
  }
  template <class Use>
  void each_cell(Use&& use) const {
    for (std::uint32_t i = 0; i < boxes_.size(); ++i) {
      const Range range = cells(boxes_[i]);
      for (std::uint32_t y = range.low_y; y <= range.high_y; ++y) {
        for (std::uint32_t x = range.low_x; x <= range.high_x; ++x) {
          use(y * columns_ + x, i);
        }
      }
    }
  }

  std::vector<Box2> boxes_;
  Box2 all_;
  double cell_ = 1.0;
  std::uint32_t columns_ = 1;
  std::uint32_t rows_ = 1;
  std::vector<std::uint32_t> first_;  // of each cell in items_, and one more
  std::vector<std::uint32_t> items_;  // boxes, cell by cell, ascending within a cell
};

// Things found by place, however unevenly they lie: a balanced tree of boxes, in the plane and in space.

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
/// Two questions in the program have containers of their own: the many boxes of one size in a net a grid
/// (BoxGrid), and faces that move while they are searched circles (unfold/search/circle_tree.hpp). The
/// reasons are in docs/design/architecture.md, "Written here, and why".
template <class Box>
class BoxTree {
 public:
  using Point = decltype(Box::low);

  /// Items 0 .. count - 1: box_of(i) must not be empty, centre_of(i) is any point in it. Equal centres are
  /// ordered by their numbers, so one list makes one tree on every machine. O(n log n).
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

/// Which boxes of a list touch each other.
class NearBoxes {
 public:
  /// O(n log n) for n boxes, none empty.
  explicit NearBoxes(const std::vector<Box3>& boxes)
      : tree_(
            boxes.size(), [&](std::uint32_t i) { return boxes[i]; },
            [&](std::uint32_t i) { return centre(boxes[i]); }) {
    boxes_.reserve(boxes.size());
    for (const std::uint32_t i : tree_.order()) {
      boxes_.push_back(boxes[i]);
    }
  }

  /// Calls visit(i, j) once for each pair of boxes that share a point. In no particular order.
  template <class Visit>
  void for_pairs(Visit visit) const {
    for (std::uint32_t i = 0; i < boxes_.size(); ++i) {
      tree_.search([&](std::uint32_t node) { return meet(tree_.box(node), boxes_[i]); },
                   [&](std::uint32_t j) {
                     if (i < j && meet(boxes_[i], boxes_[j])) {
                       visit(tree_.order()[i], tree_.order()[j]);
                     }
                   });
    }
  }

 private:
  BoxTree<Box3> tree_;
  std::vector<Box3> boxes_;  ///< in the order of the leaves
};

}  // namespace ridgecraft
