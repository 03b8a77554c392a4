// SPDX-License-Identifier: GPL-3.0-or-later
// Why a model is more pieces than it has parts: what stops a piece from being one with its neighbours.
#pragma once

#include "base/context.hpp"
#include "unfold/net/nets.hpp"
#include "unfold/patch/problem.hpp"

namespace ridgecraft::unfold {

/// Sets the reason of each piece but the first of each part, which stands for it: that nothing else of its
/// part hangs together with it, else what joining it to a neighbour along any of its cuts would break, along
/// most of them where it isn't the same everywhere. Where nothing stops it, one piece costs more than two. Of
/// a small part it is proven how many nets it needs (search/least_forest.hpp). `folds`: the forest of the
/// nets. O(cuts times faces of two pieces). Throws Error(interrupted).
void find_reasons(const NetProblem& problem, const Folds& folds, Nets& nets, const Context& context);

}  // namespace ridgecraft::unfold
