// SPDX-License-Identifier: GPL-3.0-or-later
// Parts are divided, round by round, until all are within the tolerance.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "segment/cutting/part_tasks.hpp"

namespace ridgecraft::segment {

/// A part that is within the tolerance, or can't be divided.
struct MeasuredPart {
  Facets facets;
  int depth = 0;  ///< cuts that it came from since division began
  PartReason reason = PartReason::component;
  double concavity = 0.0;
  Hull hull;
};

/// Parts by smallest facet, and how dividing went.
struct Division {
  std::vector<MeasuredPart> parts;
  int depth = 0;             ///< cuts that the most divided part came from
  std::size_t splits = 0;    ///< times that no cut made two pieces: facets went to the nearer end
  std::size_t halvings = 0;  ///< times that a part was halved because cutting it had gone on too long
};

/// Measures these parts, and divides those that are too concave, and so on with the pieces. `valleys`: what
/// is known; what is found is added. `progress` is called with the share done, from one thread at a time, and
/// the share never falls. Ends on any input: each step makes at least two parts of one.
[[nodiscard]] Division divide_all(PartWorkers& workers, std::vector<PartTask> tasks,
                                  const MeasureOptions& options, ValleyCache& valleys,
                                  const std::function<void(double share)>& progress);

}  // namespace ridgecraft::segment
