// SPDX-License-Identifier: GPL-3.0-or-later
// How many wishes for edges didn't come true.
#pragma once

#include <cstddef>

#include "base/id.hpp"
#include "unfold/net/edge_wishes.hpp"
#include "unfold/net/nets.hpp"

namespace ridgecraft::unfold {

/// How many edges that were to be kept are cut in these nets: Nets::broken_wishes. O(n).
[[nodiscard]] inline std::size_t count_broken(const EdgeWishes& wishes, const Nets& nets) {
  std::size_t broken = 0;
  for (const EdgeId e : ids<EdgeId>(wishes.size())) {
    broken += wishes[e] == EdgeWish::keep && nets.use[e] == EdgeUse::cut ? 1U : 0U;
  }
  return broken;
}

}  // namespace ridgecraft::unfold
