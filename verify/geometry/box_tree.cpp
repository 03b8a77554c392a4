// SPDX-License-Identifier: GPL-3.0-or-later
#include "verify/geometry/box_tree.hpp"

#include <numeric>
#include <utility>

namespace ridgecraft::verify {

namespace {

constexpr std::uint32_t leaf_size = 4;

void add(Box2& box, const Box2& other) {
  box.add(other.low);
  box.add(other.high);
}

}  // namespace

BoxTree::BoxTree(std::vector<Box2> boxes) : boxes_(std::move(boxes)), order_(boxes_.size()) {
  std::iota(order_.begin(), order_.end(), 0U);
  if (!boxes_.empty()) {
    build(0, static_cast<std::uint32_t>(order_.size()));
  }
}

std::uint32_t BoxTree::build(std::uint32_t begin, std::uint32_t end) {
  const auto number = static_cast<std::uint32_t>(nodes_.size());
  Node node{Box2{}, begin, end, 0};
  Box2 centres;
  for (std::uint32_t i = begin; i < end; ++i) {
    const Box2& box = boxes_[order_[i]];
    add(node.box, box);
    centres.add(0.5 * (box.low + box.high));
  }
  nodes_.push_back(node);
  if (end - begin <= leaf_size) {
    return number;
  }
  const bool by_x = centres.size().x >= centres.size().y;
  const std::uint32_t middle = begin + (end - begin) / 2;
  const auto doubled_centre = [&](std::uint32_t i) {
    return by_x ? boxes_[i].low.x + boxes_[i].high.x : boxes_[i].low.y + boxes_[i].high.y;
  };
  std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                   [&](std::uint32_t a, std::uint32_t b) {
                     const double left = doubled_centre(a);
                     const double right = doubled_centre(b);
                     return left != right ? left < right : a < b;
                   });
  build(begin, middle);
  const std::uint32_t right = build(middle, end);
  nodes_[number].right = right;
  return number;
}

}  // namespace ridgecraft::verify
