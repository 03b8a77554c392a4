// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/cutting/division.hpp"

#include <algorithm>
#include <utility>

namespace ridgecraft::segment {
namespace {

/// Takes over what is done and gives the pieces of the rest, as tasks of the next round.
std::vector<PartTask> take_round(std::vector<PartTask> tasks, std::vector<TaskOutcome> outcomes,
                                 Division& division) {
  std::vector<PartTask> pieces;
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    PartTask& task = tasks[i];
    TaskOutcome& outcome = outcomes[i];
    if (outcome.pieces.empty()) {
      division.parts.push_back(
          {std::move(task.facets), task.depth, task.reason, outcome.concavity, std::move(outcome.hull)});
      continue;
    }
    const int depth = task.depth + 1;
    division.depth = std::max(division.depth, depth);
    if (!outcome.cut) {
      ++(outcome.halved ? division.halvings : division.splits);
    }
    for (Facets& piece : outcome.pieces) {
      pieces.push_back({std::move(piece), depth, outcome.cut ? PartReason::ridge : PartReason::split});
    }
  }
  return pieces;
}

}  // namespace

Division divide_all(PartWorkers& workers, std::vector<PartTask> tasks, const MeasureOptions& options,
                    ValleyCache& valleys, const std::function<void(double share)>& progress) {
  const auto total = static_cast<double>(std::max<std::size_t>(1, workers.surface().facet_count()));
  Division division;
  double before = 0.0;  // facets done in earlier rounds
  while (!tasks.empty()) {
    double round = 0.0;
    std::vector<TaskOutcome> outcomes = workers.run(tasks, options, valleys, [&](double facets) {
      round = facets;
      progress(std::min(1.0, (before + facets) / total));
    });
    before += round;
    tasks = take_round(std::move(tasks), std::move(outcomes), division);
  }
  std::sort(division.parts.begin(), division.parts.end(),
            [](const MeasuredPart& a, const MeasuredPart& b) { return a.facets.front() < b.facets.front(); });
  return division;
}

}  // namespace ridgecraft::segment
