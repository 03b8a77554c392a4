// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/float_order.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <utility>

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

}  // namespace

std::vector<std::uint32_t> ascending_order(std::span<const float> numbers) {
  return order_of(numbers, 0U);
}

std::vector<std::uint32_t> descending_order(std::span<const float> numbers) {
  return order_of(numbers, ~0U);
}

}  // namespace ridgecraft
