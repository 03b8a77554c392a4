// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/search/circle_tree.hpp"

namespace ridgecraft::unfold {

void CircleTree::renew(std::uint32_t first, std::uint32_t last) {
  if (first >= last) {
    return;
  }
  std::uint32_t low = leaves_ + first / block_size;
  std::uint32_t high = leaves_ + (last - 1) / block_size;
  for (std::uint32_t node = low; node <= high; ++node) {
    const Block& block = blocks_[node - leaves_];
    // Round the middle of the centres' box; a block isn't full only at the end of the sequence.
    Box2 box;
    std::uint32_t count = 0;
    for (; count < block_size && block.x[count / 4][count % 4] != nowhere; ++count) {
      box.add(block.circle(count).centre);
    }
    Circle& circle = nodes_[node];
    circle = {0.5 * (box.low + box.high), 0.0};
    for (std::uint32_t k = 0; k < count; ++k) {
      const Circle one = block.circle(k);
      circle.radius = std::max(circle.radius, length(one.centre - circle.centre) + one.radius);
    }
  }
  for (low /= 2, high /= 2; low > 0; low /= 2, high /= 2) {
    for (std::uint32_t i = low; i <= high; ++i) {
      nodes_[i] = around(nodes_[2 * std::size_t{i}], nodes_[2 * std::size_t{i} + 1]);
    }
  }
}

Circle smallest_circle(Vec2 a, Vec2 b, Vec2 c) {
  // On the longest side unless the triangle is acute, then through all three corners.
  const double ab = dot(b - a, b - a);
  const double bc = dot(c - b, c - b);
  const double ca = dot(a - c, a - c);
  const double longest = std::max({ab, bc, ca});
  Circle circle;
  const double doubled = cross(b - a, c - a);
  if (ab + bc + ca <= 2.0 * longest || !(std::abs(doubled) > 0.0)) {
    circle.centre = longest == ab ? 0.5 * (a + b) : longest == bc ? 0.5 * (b + c) : 0.5 * (c + a);
  } else {
    const Vec2 u = b - a;
    const Vec2 v = c - a;
    circle.centre =
        a + Vec2{(v.y * ab - u.y * ca) / (2.0 * doubled), (u.x * ca - v.x * ab) / (2.0 * doubled)};
  }
  for (const Vec2 p : {a, b, c}) {
    circle.radius = std::max(circle.radius, length(p - circle.centre));
  }
  return circle;
}

}  // namespace ridgecraft::unfold
