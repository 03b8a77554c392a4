// SPDX-License-Identifier: GPL-3.0-or-later
// What cutting divided too far is put together: by the merge pass, or by the attempts of more effort.
#pragma once

#include <vector>

#include "segment/cutting/division.hpp"
#include "segment/joining/assembly.hpp"

namespace ridgecraft::segment {

/// What joining works with, on one thread.
struct JoiningTools {
  Measurer* measurer;
  const EdgeWeights* weights;
  Assembly* assembly;    ///< null: the merge pass is all
  ValleyCache* valleys;  ///< known ones; those that are found are added
};

/// Joins parts that are within the tolerance to fewer that are, too. A part that comes out as it went in
/// keeps its reason.
[[nodiscard]] std::vector<PartTask> join_parts(std::vector<MeasuredPart> parts, const JoiningTools& tools);

/// The same parts as tasks.
[[nodiscard]] std::vector<PartTask> leave_parts(std::vector<MeasuredPart> parts);

struct Rejoined {
  std::vector<MeasuredPart> kept;
  std::vector<PartTask> changed;  ///< within the tolerance from scratch, but not known how far
};

/// Joins parts of which the last measurement divided some (their depth is above 0): these with each other and
/// with their neighbours, where the union is within the tolerance from scratch.
[[nodiscard]] Rejoined rejoin_divided(std::vector<MeasuredPart> parts, const JoiningTools& tools);

}  // namespace ridgecraft::segment
