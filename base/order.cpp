// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/order.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <numeric>
#include <utility>

#include "base/context.hpp"
#include "base/no_index.hpp"
#include "base/random.hpp"

namespace ridgecraft {
namespace {

/// 32 bits have three parts.
constexpr unsigned part_bits = 11;
constexpr std::size_t parts = 3;
constexpr std::uint32_t part_values = 1U << part_bits;
/// Fewer numbers aren't worth being counted first.
constexpr std::size_t few = 1024;

/// A number's bits, which are in the number's order, and where it is.
struct Item {
  std::uint32_t key;
  std::uint32_t at;
};

std::uint32_t part_of_key(std::uint32_t key, std::size_t which) {
  return (key >> (which * part_bits)) & (part_values - 1U);
}

std::vector<std::uint32_t> order_of(std::span<const float> numbers, std::uint32_t flipped) {
  std::vector<Item> items(numbers.size());
  for (std::uint32_t i = 0; i < items.size(); ++i) {
    // A zero's sign isn't to tell.
    items[i] = {std::bit_cast<std::uint32_t>(numbers[i] + 0.0F) ^ flipped, i};
  }
  if (items.size() < few) {
    std::stable_sort(items.begin(), items.end(), [](Item a, Item b) { return a.key < b.key; });
  } else {
    std::array<std::vector<std::uint32_t>, parts> next;
    next.fill(std::vector<std::uint32_t>(part_values, 0));
    for (const Item item : items) {
      for (std::size_t d = 0; d < parts; ++d) {
        ++next[d][part_of_key(item.key, d)];
      }
    }
    std::vector<Item> sorted(items.size());
    for (std::size_t d = 0; d < parts; ++d) {
      std::uint32_t first = 0;
      for (std::uint32_t& n : next[d]) {
        first += std::exchange(n, first);
      }
      for (const Item item : items) {
        sorted[next[d][part_of_key(item.key, d)]++] = item;
      }
      items.swap(sorted);
    }
  }
  std::vector<std::uint32_t> order(items.size());
  std::transform(items.begin(), items.end(), order.begin(), [](Item item) { return item.at; });
  return order;
}

/// Cells of the curve along each side of the box: 2 to this power. Places are sorted by as many bits in each
/// of three rounds.
constexpr unsigned curve_bits = 10;
constexpr std::uint32_t digits = 1U << curve_bits;
constexpr double last_cell = digits - 1.0;

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

/// Place on the curve of a point whose coordinates are numbers of cells; others count as the nearest of
/// these, what is no number as 0.
std::uint32_t place_on_curve(Vec3 cell) {
  return spread(cell_number(cell.x)) | spread(cell_number(cell.y)) << 1U | spread(cell_number(cell.z)) << 2U;
}

/// 0 and -0 are one place.
std::uint64_t bits(double x) {
  return std::bit_cast<std::uint64_t>(x + 0.0);
}

std::uint64_t hash(Vec3 p) {
  return Random(Random(Random(bits(p.x)).next() ^ bits(p.y)).next() ^ bits(p.z)).next();
}

}  // namespace

std::vector<std::uint32_t> ascending_order(std::span<const float> numbers) {
  return order_of(numbers, 0U);
}

std::vector<std::uint32_t> descending_order(std::span<const float> numbers) {
  return order_of(numbers, ~0U);
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
  for (unsigned shift = 0; shift < 3 * curve_bits; shift += curve_bits) {
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

std::vector<std::uint32_t> first_at_place(std::span<const Vec3> points,
                                          std::span<const std::uint8_t> counts) {
  std::vector<std::uint32_t> first(points.size());
  // Open addressing, at most half full. Only whether a point is there is asked, never in which order.
  std::vector<std::uint32_t> table(std::bit_ceil(2 * points.size() + 1), no_index);
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    first[i] = i;
    if (!counts.empty() && counts[i] == 0) {
      continue;
    }
    std::size_t slot = hash(points[i]) & (table.size() - 1);
    while (table[slot] != no_index && points[table[slot]] != points[i]) {
      slot = (slot + 1) & (table.size() - 1);
    }
    if (table[slot] == no_index) {
      table[slot] = i;
    }
    first[i] = table[slot];
  }
  return first;
}

}  // namespace ridgecraft
