// SPDX-License-Identifier: GPL-3.0-or-later
// What the searches report of single parts, as messages about the pieces that the user sees.
#pragma once

#include <compare>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/context.hpp"
#include "base/message.hpp"
#include "unfold/net/nets.hpp"
#include "unfold/patch/patch.hpp"
#include "unfold/plan.hpp"

namespace ridgecraft::unfold {

/// A fact about a part while its pieces have no names yet.
struct PartNote {
  Message what;
  FaceId face;  ///< one of the part's
};

/// One message for each fact, in the order in which they first appear, each part named by all of its pieces:
/// "the part of D and E: ...", "the parts of D and E; G; and 62 more: ...". O(facts x pieces).
[[nodiscard]] std::vector<Message> messages(std::span<const PartNote> notes, const Nets& nets);

// The first nets: each part by itself, all at the same time.

/// Why a face of the surface lies in another piece than the one that stands for its part: what the step that
/// cut them apart says. PieceReason::part in that one.
struct Cause {
  PieceReason reason = PieceReason::part;
  std::uint32_t piece = nothing;  ///< what was cut off in one piece has one number: that of a face

  friend auto operator<=>(const Cause&, const Cause&) = default;
};
using Causes = std::vector<Cause>;

/// The whole surface as one patch: its face i is face i of the surface, and what searches keep whole is
/// frozen. O(n log n).
[[nodiscard]] Patch whole_patch(const UnfoldProblem& problem, const Plan& plan);

struct UnfoldedParts {
  Folds folds;    ///< of whole_patch
  Causes causes;  ///< per face
  std::vector<PartNote> notes;
};

/// Each connected set of faces of one group (Plan::group) by itself, as in pieces/patch_nets.hpp; as many at
/// a time as there are threads. Deterministic for one seed but for the deadline. Throws Error(interrupted).
[[nodiscard]] UnfoldedParts unfold_parts(const UnfoldProblem& problem, const Plan& plan,
                                         const Context& context);

}  // namespace ridgecraft::unfold
