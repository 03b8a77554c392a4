// SPDX-License-Identifier: GPL-3.0-or-later
// What is settled before anything is unfolded: what pieces have room for, what stays whole, which constraints
// can come true.
#pragma once

#include <string>
#include <vector>

#include "base/context.hpp"
#include "base/id.hpp"
#include "base/message.hpp"
#include "mesh/model/surface.hpp"
#include "prepare/prepared/panels.hpp"
#include "unfold/net/edge_constraints.hpp"
#include "unfold/net/options.hpp"
#include "unfold/patch/patch.hpp"
#include "unfold/patch/problem.hpp"
#include "unfold/pieces/symmetry.hpp"

namespace ridgecraft::unfold {

/// What follows from a problem before the first search. Where nothing is too large and nothing is requested,
/// its panels and groups are those that were given.
struct Plan {
  Room room;  ///< that each piece has
  /// What searches keep whole: the flat regions, but those that no piece could hold are divided. Between two
  /// shares of one region lies an edge like any other, which may be cut and then wants a tab.
  prepare::Panels whole;
  EdgeConstraints possible_constraints;  ///< of those in UnfoldProblem::options; empty if there are none
  IdVector<FaceId, PartId> group;  ///< faces that are unfolded together: parts that keep what is to be kept
  std::vector<Message> notes;      ///< for Nets::notes
};

/// Throws Error(no_nets) where a face is larger than the sheet: it can't be cut from any. O(n).
void refuse_large_faces(const UnfoldProblem& problem);

/// O(n) but for regions that have to be divided and constraints. Throws Error(interrupted).
[[nodiscard]] Plan make_plan(const UnfoldProblem& problem, const Symmetry& symmetry, const Context& context);

/// The whole surface as one patch: its face i is face i of the surface, and what searches keep whole is
/// frozen. O(n log n).
[[nodiscard]] Patch whole_patch(const UnfoldProblem& problem, const Plan& plan);

}  // namespace ridgecraft::unfold
