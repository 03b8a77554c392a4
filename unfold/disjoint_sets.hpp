// SPDX-License-Identifier: GPL-3.0-or-later
// Disjoint sets with union by size and path halving (R. Tarjan, J. van Leeuwen, JACM 31, 1984).
#pragma once

#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace ridgecraft::unfold {

class DisjointSets {
 public:
  explicit DisjointSets(std::uint32_t count) : parent_(count), size_(count, 1) {
    std::iota(parent_.begin(), parent_.end(), 0U);
  }
  std::uint32_t find(std::uint32_t i) {
    while (parent_[i] != i) {
      parent_[i] = parent_[parent_[i]];
      i = parent_[i];
    }
    return i;
  }
  /// False when they were one set already.
  bool join(std::uint32_t a, std::uint32_t b) {
    a = find(a);
    b = find(b);
    if (a == b) {
      return false;
    }
    if (size_[a] < size_[b]) {
      std::swap(a, b);
    }
    parent_[b] = a;
    size_[a] += size_[b];
    return true;
  }

 private:
  std::vector<std::uint32_t> parent_;
  std::vector<std::uint32_t> size_;
};

}  // namespace ridgecraft::unfold
