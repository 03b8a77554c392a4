// SPDX-License-Identifier: GPL-3.0-or-later
// A forest that is being split for tabs: what cutting and uniting hand to each other.
#pragma once

#include <cstddef>
#include <functional>

#include "unfold/net/nets.hpp"
#include "unfold/patch/patch.hpp"

namespace ridgecraft::unfold {

/// The nets of a forest with all their tabs, as they will be returned. Asked from several threads.
using NetsOf = std::function<Nets(const Folds&)>;

struct TabSplit {
  Folds folds;
  std::size_t missing = 0;  ///< joins that could have a usable tab (TabGaps::able) and have none
};

}  // namespace ridgecraft::unfold
