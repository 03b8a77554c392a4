// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/search/random_swaps.hpp"

#include "base/random.hpp"

namespace ridgecraft::unfold {

std::optional<Swap> draw_swap_at(std::uint32_t cut, const Patch& patch, RootedNet& net, Random& random) {
  const std::vector<std::uint32_t>& path = net.removable_between(cut / 3, patch.twin[cut] / 3);
  if (path.empty()) {
    return std::nullopt;
  }
  return Swap{draw(path, random), cut};
}

std::optional<Swap> draw_swap_between(std::uint32_t f, std::uint32_t g, RootedNet& net, Branch& branch,
                                      Random& random) {
  const std::vector<std::uint32_t>& path = net.removable_between(f, g);
  if (path.empty()) {
    return std::nullopt;
  }
  const std::uint32_t below = draw(path, random);
  branch.find(net.folds(), net.side_above(below), f);
  if (branch.places().empty()) {
    return std::nullopt;
  }
  return Swap{below, draw(branch.places(), random)};
}

}  // namespace ridgecraft::unfold
