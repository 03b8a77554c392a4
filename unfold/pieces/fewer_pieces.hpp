// SPDX-License-Identifier: GPL-3.0-or-later
// As few pieces as paper and overlap allow, whatever the parts are.
#pragma once

#include "base/context.hpp"
#include "unfold/patch/patch.hpp"
#include "unfold/patch/problem.hpp"

namespace ridgecraft::unfold {

/// The forest with fewer trees, where such are found: each connected body is unfolded as if it were one part
/// (patch_nets.hpp), and taken so if that makes fewer pieces; then two pieces that meet are searched together
/// for one net, three for two, and at last all of a body for one fewer, until nothing is
/// saved. What the area or a proof says to need as many isn't tried. The
/// forest stays clean and what fits still fits. Takes as long as unfolding all parts again, and two seconds.
/// Deterministic for one seed but for the deadline. Throws Error(interrupted).
[[nodiscard]] Folds fewer_pieces(const NetProblem& problem, const Folds& folds, const Context& context);

}  // namespace ridgecraft::unfold
