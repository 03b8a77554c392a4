// SPDX-License-Identifier: GPL-3.0-or-later
// Can these faces be one piece? A quick search that is made for many unions of pieces.
#pragma once

#include <cstdint>
#include <optional>

#include "base/context.hpp"
#include "unfold/patch/patch.hpp"
#include "unfold/patch/room.hpp"

namespace ridgecraft::unfold {

struct OnePieceSearch {
  double tolerance = 0.0;  ///< mm
  int starts = 3;          ///< start trees
  std::uint64_t iterations_per_face = 2;
  std::uint64_t fit_trials = 300;  ///< of shrink_to_fit for each clean net
};

struct OnePieceFound {
  std::optional<Folds> tree;
  std::uint64_t cost = 0;  ///< faces times iterations: about four million a second
};

/// A tree of a connected patch, panels whole, that has no overlap and fits the room; none where the search
/// finds none. The first that is found is taken.
[[nodiscard]] OnePieceFound find_one_piece(const Patch& patch, const Room& room, const OnePieceSearch& search,
                                           std::uint64_t seed, const Context& context);

}  // namespace ridgecraft::unfold
