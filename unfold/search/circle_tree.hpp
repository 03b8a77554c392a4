// SPDX-License-Identifier: GPL-3.0-or-later
// A bounding hierarchy of circles over a sequence of faces: the n-th leaf encloses the n-th face of the
// order.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

#include "base/vector.hpp"
#include "unfold/search/lanes.hpp"

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

/// Circles of a sequence of faces in blocks of eight, and a complete binary tree over the blocks: node 1 is
/// the root, node i has the children 2 i and 2 i + 1, block b is node first_leaf() + b. A circle can be moved
/// by moving its centre, so the tree of a set of faces that moves needs no rebuilding to be asked about.
///
/// Within a block the circles lie as single-precision numbers side by side, for one comparison of eight at a
/// time; their radii are enlarged by more than the rounding, so none that meets is missed.
class CircleTree {
 public:
  static constexpr std::uint32_t block_size = 8;

  void reset(std::uint32_t count) {
    const std::uint32_t blocks = (count + block_size - 1) / block_size;
    leaves_ = std::bit_ceil(std::max(blocks, 2U));
    nodes_.assign(2 * std::size_t{leaves_}, Circle{});
    blocks_.assign(blocks, Block{});
  }
  [[nodiscard]] std::uint32_t first_leaf() const { return leaves_; }
  [[nodiscard]] const Circle& operator[](std::uint32_t node) const { return nodes_[node]; }

  void set(std::uint32_t position, const Circle& circle) {
    Block& block = blocks_[position / block_size];
    const std::uint32_t k = position % block_size;
    block.x[k / 4][k % 4] = static_cast<float>(circle.centre.x);
    block.y[k / 4][k % 4] = static_cast<float>(circle.centre.y);
    block.radius[k / 4][k % 4] = enlarged(circle);
  }
  /// The circle at a position, a little enlarged.
  [[nodiscard]] Circle circle(std::uint32_t position) const {
    return blocks_[position / block_size].circle(position % block_size);
  }

  /// Bits of the circles of a block that meet this one (and perhaps of some that nearly do).
  [[nodiscard]] std::uint32_t meeting(std::uint32_t block_number, const Circle& circle) const {
    const Block& block = blocks_[block_number];
    const auto x = static_cast<float>(circle.centre.x);
    const auto y = static_cast<float>(circle.centre.y);
    const float radius = enlarged(circle);
    std::uint32_t bits = 0;
    for (std::uint32_t half = 0; half < 2; ++half) {
      const FloatLanes dx = block.x[half] - x;
      const FloatLanes dy = block.y[half] - y;
      const FloatLanes reach = block.radius[half] + radius;
      bits |= bits_of(dx * dx + dy * dy < reach * reach) << (4 * half);
    }
    return bits;
  }

  /// Renews the blocks that hold the positions first .. last-1 and all nodes above. O(last - first + log n).
  void renew(std::uint32_t first, std::uint32_t last);

  /// Calls use(node) for the O(log n) nodes that together cover exactly the blocks first .. last-1.
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
  /// Far from everything: what no circle meets. Its square is still a single-precision number.
  static constexpr float nowhere = 1e18F;

  struct Block {
    std::array<FloatLanes, 2> x, y, radius;
    Block() {
      x.fill(FloatLanes{} + nowhere);
      y.fill(FloatLanes{} + nowhere);
      radius.fill(FloatLanes{});
    }
    [[nodiscard]] Circle circle(std::uint32_t k) const {
      return {{static_cast<double>(x[k / 4][k % 4]), static_cast<double>(y[k / 4][k % 4])},
              static_cast<double>(radius[k / 4][k % 4])};
    }
  };

  /// Single precision rounds a coordinate by up to 6e-8 of it.
  static float enlarged(const Circle& circle) {
    return static_cast<float>(circle.radius * (1.0 + 1e-6) +
                              1e-6 * (std::abs(circle.centre.x) + std::abs(circle.centre.y)));
  }

  std::uint32_t leaves_ = 2;
  std::vector<Circle> nodes_;
  std::vector<Block> blocks_;
};

/// The smallest circle around a triangle's corners.
[[nodiscard]] Circle smallest_circle(Vec2 a, Vec2 b, Vec2 c);

}  // namespace ridgecraft::unfold
