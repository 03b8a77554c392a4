// SPDX-License-Identifier: GPL-3.0-or-later
// A bounding hierarchy of circles over a sequence of faces: the n-th leaf encloses the n-th face of the
// order.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

#include "mesh/vector.hpp"

namespace ridgecraft::unfold {

struct Circle {
  Vec2 centre;
  double radius = -1.0;  ///< negative: encloses nothing
};

/// The smallest circle around two others.
[[nodiscard]] inline Circle around(const Circle& a, const Circle& b) {
  if (a.radius < 0.0) {
    return b;
  }
  if (b.radius < 0.0) {
    return a;
  }
  const Vec2 way = b.centre - a.centre;
  const double squared = dot(way, way);
  const double spread = b.radius - a.radius;
  if (squared <= spread * spread) {
    return spread > 0.0 ? b : a;
  }
  const double distance = std::sqrt(squared);
  const double radius = 0.5 * (distance + a.radius + b.radius);
  return {a.centre + ((radius - a.radius) / distance) * way, radius};
}

[[nodiscard]] inline bool apart(const Circle& a, const Circle& b) {
  const Vec2 way = b.centre - a.centre;
  const double reach = a.radius + b.radius;
  return dot(way, way) >= reach * reach;
}

/// Complete binary tree in an array: node 1 is the root, node i has the children 2 i and 2 i + 1, leaf p is
/// node first_leaf() + p. A circle can be moved by moving its centre, so the tree of a moved set of faces
/// needs no rebuilding to be asked about.
class CircleTree {
 public:
  void reset(std::uint32_t leaves) {
    leaves_ = std::bit_ceil(std::max(leaves, 2U));
    nodes_.assign(2 * std::size_t{leaves_}, Circle{});
  }
  [[nodiscard]] std::uint32_t first_leaf() const { return leaves_; }
  [[nodiscard]] const Circle& operator[](std::uint32_t node) const { return nodes_[node]; }
  void set_leaf(std::uint32_t position, const Circle& circle) { nodes_[leaves_ + position] = circle; }

  /// Renews all nodes above the leaves first .. last-1. O(last - first + log n).
  void renew(std::uint32_t first, std::uint32_t last) {
    if (first >= last) {
      return;
    }
    std::uint32_t low = (leaves_ + first) / 2;
    std::uint32_t high = (leaves_ + last - 1) / 2;
    for (; low > 0; low /= 2, high /= 2) {
      for (std::uint32_t i = low; i <= high; ++i) {
        nodes_[i] = around(nodes_[2 * std::size_t{i}], nodes_[2 * std::size_t{i} + 1]);
      }
    }
  }

  /// Calls use(node) for the O(log n) nodes that together cover exactly the leaves first .. last-1.
  template <class Use>
  void cover(std::uint32_t first, std::uint32_t last, Use use) const {
    for (std::uint32_t l = leaves_ + first, r = leaves_ + last; l < r; l /= 2, r /= 2) {
      if ((l & 1U) != 0) {
        use(l++);
      }
      if ((r & 1U) != 0) {
        use(--r);
      }
    }
  }

 private:
  std::uint32_t leaves_ = 2;
  std::vector<Circle> nodes_;
};

/// The smallest circle around a triangle's corners.
[[nodiscard]] Circle smallest_circle(Vec2 a, Vec2 b, Vec2 c);

}  // namespace ridgecraft::unfold
