// SPDX-License-Identifier: GPL-3.0-or-later
// The first nets: each part by itself, all at the same time.
#pragma once

#include <string>
#include <vector>

#include "base/context.hpp"
#include "unfold/net/nets.hpp"
#include "unfold/patch/patch.hpp"
#include "unfold/plan.hpp"

namespace ridgecraft::unfold {

/// Why each face of the surface lies in another piece than its neighbours: what the step that cut them apart
/// says. PieceReason::part where that was the border of a part.
using Causes = std::vector<PieceReason>;

/// The whole surface as one patch: its face i is face i of the surface, and what searches keep whole is
/// frozen. O(n log n).
[[nodiscard]] Patch whole_patch(const Asked& asked, const Plan& plan);

struct UnfoldedParts {
  Folds folds;                     ///< of whole_patch
  Causes causes;                   ///< per face
  std::vector<std::string> notes;  ///< for Nets::notes
};

/// Each connected set of faces of one group (Plan::group) by itself, as in pieces/patch_nets.hpp; as many at
/// a time as there are threads. Deterministic for one seed but for the deadline. Throws Error(interrupted).
[[nodiscard]] UnfoldedParts unfold_parts(const Asked& asked, const Plan& plan, const Context& context);

}  // namespace ridgecraft::unfold
