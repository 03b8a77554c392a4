// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/curve_order.hpp"

#include <algorithm>
#include <array>
#include <numeric>

namespace ridgecraft {
namespace {

/// Digits by which places are sorted: three rounds of counting.
constexpr unsigned digit_bits = curve_bits;
constexpr std::uint32_t digits = 1U << digit_bits;

constexpr double last_cell = static_cast<double>((1U << curve_bits) - 1U);

/// Written so that NaN, which infinity times 0 makes of an extent beyond all measure, comes out as 0.
std::uint32_t cell_number(double x) {
  return x > 0.0 ? static_cast<std::uint32_t>(std::min(x, last_cell)) : 0U;
}

/// Spreads ten bits to every third place.
std::uint32_t spread(std::uint32_t x) {
  x = (x | x << 16U) & 0x030000ffU;
  x = (x | x << 8U) & 0x0300f00fU;
  x = (x | x << 4U) & 0x030c30c3U;
  return (x | x << 2U) & 0x09249249U;
}

}  // namespace

std::uint32_t place_on_curve(Vec3 cell) {
  return spread(cell_number(cell.x)) | spread(cell_number(cell.y)) << 1U | spread(cell_number(cell.z)) << 2U;
}

std::vector<std::uint32_t> curve_order(std::span<const Vec3> points) {
  Box3 box;
  for (const Vec3 p : points) {
    box.add(p);
  }
  const double largest = points.empty() ? 0.0 : box.largest_extent();
  const double cells = largest > 0.0 ? last_cell / largest : 0.0;
  std::vector<std::uint32_t> place(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    place[i] = place_on_curve(cells * (points[i] - box.low));
  }
  std::vector<std::uint32_t> order(points.size());
  std::iota(order.begin(), order.end(), 0U);
  std::vector<std::uint32_t> sorted(points.size());
  for (unsigned shift = 0; shift < 3 * curve_bits; shift += digit_bits) {
    std::array<std::uint32_t, digits + 1> first{};
    for (const std::uint32_t p : place) {
      ++first[((p >> shift) & (digits - 1)) + 1];
    }
    std::partial_sum(first.begin(), first.end(), first.begin());
    for (const std::uint32_t i : order) {
      sorted[first[(place[i] >> shift) & (digits - 1)]++] = i;
    }
    order.swap(sorted);
  }
  return order;
}

}  // namespace ridgecraft
