// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/patch/branch.hpp"

namespace ridgecraft::unfold {

void Branch::find(const Folds& tree, std::uint32_t removed, std::uint32_t from) {
  for (const std::uint32_t f : faces_) {
    inside_[f] = 0;
  }
  faces_.assign(1, from);
  inside_[from] = 1;
  for (std::size_t i = 0; i < faces_.size(); ++i) {
    for (std::uint32_t side = 3 * faces_[i]; side < 3 * faces_[i] + 3; ++side) {
      const std::uint32_t twin = patch_.twin[side];
      if (twin == nothing || tree[side] == 0 || side == removed || twin == removed ||
          inside_[twin / 3] != 0) {
        continue;
      }
      inside_[twin / 3] = 1;
      faces_.push_back(twin / 3);
    }
  }
  places_.clear();
  for (const std::uint32_t f : faces_) {
    for (std::uint32_t side = 3 * f; side < 3 * f + 3; ++side) {
      const std::uint32_t twin = patch_.twin[side];
      if (twin != nothing && tree[side] == 0 && inside_[twin / 3] == 0 && patch_.frozen[side] == 0) {
        places_.push_back(side);
      }
    }
  }
}

}  // namespace ridgecraft::unfold
