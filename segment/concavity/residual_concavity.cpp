// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/concavity/residual_concavity.hpp"

#include <algorithm>

#include "base/segment.hpp"

namespace ridgecraft::segment {
namespace {

/// A corner of the new bridges, with the concavity of all pockets up to it.
struct Corner {
  std::size_t position;
  double concavity;
};

}  // namespace

void prefix_concavity(std::span<const Vec2> chain, std::vector<double>& prefix) {
  prefix.assign(chain.size(), 0.0);
  std::vector<Corner> stack;
  for (std::size_t k = 0; k < chain.size(); ++k) {
    const Vec2 q = chain[k];
    while (stack.size() >= 2) {
      const Vec2 s1 = chain[stack.back().position];
      const Vec2 s2 = chain[stack[stack.size() - 2].position];
      if (cross(s1 - s2, q - s2) > 0.0) {
        break;
      }
      stack.pop_back();
    }
    double pocket = 0.0;
    if (!stack.empty()) {
      const std::size_t top = stack.back().position;
      for (std::size_t i = top + 1; i < k; ++i) {
        pocket = std::max(pocket, distance_to_segment(chain[i], chain[top], q));
      }
      pocket = std::max(pocket, stack.back().concavity);
    }
    stack.push_back({k, pocket});
    prefix[k] = pocket;
  }
}

void suffix_concavity(std::span<const Vec2> chain, std::vector<double>& suffix) {
  std::vector<Vec2> mirrored(chain.rbegin(), chain.rend());
  for (Vec2& p : mirrored) {
    p.x = chain.back().x - p.x;
  }
  prefix_concavity(mirrored, suffix);
  std::reverse(suffix.begin(), suffix.end());
}

}  // namespace ridgecraft::segment
