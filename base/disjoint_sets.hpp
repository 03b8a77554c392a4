// SPDX-License-Identifier: GPL-3.0-or-later
// Disjoint sets with path halving (R. Tarjan, J. van Leeuwen, JACM 31, 1984). Header only.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace ridgecraft {

/// Disjoint sets over 0 .. size-1. The smallest member represents its set, so results don't depend on the
/// order of joining; O(log n) per call in the mean.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t size = 0) { reset(size); }
  /// Starts over with each of 0 .. size-1 alone.
  void reset(std::size_t size) {
    parent_.resize(size);
    for (std::size_t i = 0; i < size; ++i) {
      parent_[i] = static_cast<std::uint32_t>(i);
    }
  }
  std::uint32_t find(std::uint32_t i) {
    while (parent_[i] != i) {
      parent_[i] = parent_[parent_[i]];
      i = parent_[i];
    }
    return i;
  }
  /// True when the two were in different sets.
  bool join(std::uint32_t a, std::uint32_t b) {
    a = find(a);
    b = find(b);
    if (a == b) {
      return false;
    }
    parent_[a > b ? a : b] = a > b ? b : a;
    return true;
  }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace ridgecraft
