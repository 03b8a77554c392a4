// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/boxes.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "base/order.hpp"

namespace ridgecraft {
namespace {

float rounded_down(double x) {
  const auto f = static_cast<float>(x);
  return static_cast<double>(f) <= x ? f : std::nextafter(f, -std::numeric_limits<float>::infinity());
}

float rounded_up(double x) {
  const auto f = static_cast<float>(x);
  return static_cast<double>(f) >= x ? f : std::nextafter(f, std::numeric_limits<float>::infinity());
}

}  // namespace

NearBoxes::NearBoxes(const std::vector<Box3>& boxes) {
  if (boxes.empty()) {
    return;
  }
  Box3 all;
  for (const Box3& b : boxes) {
    all.add(b.low);
    all.add(b.high);
  }
  const double largest = all.largest_extent();
  const double cells = largest > 0.0 ? (static_cast<double>(1U << curve_bits) - 1.0) / largest : 0.0;
  std::vector<std::uint64_t> curve(boxes.size());
  for (std::uint32_t i = 0; i < boxes.size(); ++i) {
    const Vec3 at = cells * (0.5 * (boxes[i].low + boxes[i].high) - all.low);
    curve[i] = std::uint64_t{place_on_curve(at)} << 32U | i;
  }
  std::sort(curve.begin(), curve.end());
  // Relative to the corner of everything and its size, single precision is enough wherever the model lies.
  const double scale = largest > 0.0 ? 1.0 / largest : 0.0;
  order_.reserve(boxes.size());
  boxes_.reserve(boxes.size());
  for (const std::uint64_t entry : curve) {
    const auto i = static_cast<std::uint32_t>(entry & 0xffffffffU);
    const Vec3 low = scale * (boxes[i].low - all.low);
    const Vec3 high = scale * (boxes[i].high - all.low);
    order_.push_back(i);
    boxes_.push_back({{rounded_down(low.x), rounded_down(low.y), rounded_down(low.z)},
                      {rounded_up(high.x), rounded_up(high.y), rounded_up(high.z)}});
  }
  leaves_ = std::bit_ceil(static_cast<std::uint32_t>((boxes.size() + leaf_size - 1) / leaf_size));
  constexpr float nowhere = std::numeric_limits<float>::infinity();
  tree_.assign(2 * std::size_t{leaves_}, {{nowhere, nowhere, nowhere}, {-nowhere, -nowhere, -nowhere}});
  const auto include = [](Box& into, const Box& b) {
    for (std::size_t k = 0; k < 3; ++k) {
      into.low[k] = std::min(into.low[k], b.low[k]);
      into.high[k] = std::max(into.high[k], b.high[k]);
    }
  };
  for (std::uint32_t i = 0; i < boxes_.size(); ++i) {
    include(tree_[leaves_ + i / leaf_size], boxes_[i]);
  }
  for (std::uint32_t node = leaves_ - 1; node > 0; --node) {
    include(tree_[node], tree_[2 * node]);
    include(tree_[node], tree_[2 * node + 1]);
  }
}

}  // namespace ridgecraft
