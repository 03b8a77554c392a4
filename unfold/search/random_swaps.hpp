// SPDX-License-Identifier: GPL-3.0-or-later
// Single exchanges of a fold and a cut, drawn at random: what searches among the trees of one net try.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "base/context.hpp"
#include "base/random.hpp"
#include "unfold/patch/branch.hpp"
#include "unfold/search/rooted_net.hpp"

namespace ridgecraft::unfold {

/// The fold above the face `below` leaves the tree, the cut `side`, which crosses it, comes in.
struct Swap {
  std::uint32_t below = nothing;
  std::uint32_t side = nothing;
};

/// One of them; there must be one.
template <class T>
[[nodiscard]] const T& draw(const std::vector<T>& from, Random& random) {
  return from[random.below(static_cast<std::uint32_t>(from.size()))];
}

/// A cut comes in, and one of the folds that may leave for it goes. Nothing where none may.
[[nodiscard]] std::optional<Swap> draw_swap_at(std::uint32_t cut, const Patch& patch, RootedNet& net,
                                               Random& random);

/// One of the folds on the way from one face to another goes, and one of the cuts across it comes in, so that
/// they hang together by another way. Nothing where there is none. `branch` is space to work in.
[[nodiscard]] std::optional<Swap> draw_swap_between(std::uint32_t f, std::uint32_t g, RootedNet& net,
                                                    Branch& branch, Random& random);

}  // namespace ridgecraft::unfold
