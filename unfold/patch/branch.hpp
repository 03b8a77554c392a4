// SPDX-License-Identifier: GPL-3.0-or-later
// One side of a fold that is removed, and where it could hang instead.
#pragma once

#include <cstdint>
#include <vector>

#include "unfold/patch/patch.hpp"

namespace ridgecraft::unfold {

/// Keeps its space from one branch to the next. The patch must outlive it.
class Branch {
 public:
  explicit Branch(const Patch& patch) : patch_(patch), inside_(patch.size(), 0) {}

  /// The faces on the side of `from` when the fold `removed` (either of its sides) leaves the tree. O(their
  /// number).
  void find(const Folds& tree, std::uint32_t removed, std::uint32_t from);

  [[nodiscard]] const std::vector<std::uint32_t>& faces() const { return faces_; }
  /// Sides of its faces over which it could be folded to the rest: cut, and not frozen.
  [[nodiscard]] const std::vector<std::uint32_t>& places() const { return places_; }

 private:
  const Patch& patch_;
  std::vector<std::uint8_t> inside_;
  std::vector<std::uint32_t> faces_;
  std::vector<std::uint32_t> places_;
};

}  // namespace ridgecraft::unfold
