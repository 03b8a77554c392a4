// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/part_tasks.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "mesh/foundation/parallel.hpp"

namespace ridgecraft::segment {
namespace {

/// From this depth on parts are halved, so that no input makes the recursion linear (specification 11.3).
constexpr int deepest_cut = 60;

void divide(PartWorker& worker, int depth, TaskOutcome& outcome) {
  if (depth < deepest_cut) {
    outcome.pieces = worker.cutter.cut(worker.measurer, worker.measurement);
    outcome.cut = outcome.pieces.size() > 1;
  }
  if (!outcome.cut) {
    outcome.halved = depth >= deepest_cut;
    outcome.pieces = worker.cutter.split(worker.measurer, worker.measurement, outcome.halved);
  }
  if (outcome.pieces.size() < 2) {
    outcome.pieces.clear();
  }
}

}  // namespace

PartWorkers::PartWorkers(const ScaledSurface& surface, const VertexGraph& graph, const EdgeWeights& weights,
                         double tolerance, const Context& context, const Rules& rules)
    : surface_(&surface),
      graph_(&graph),
      weights_(&weights),
      tolerance_(tolerance),
      context_(&context),
      rules_(rules) {
  workers_.push_back(make_worker());
  idle_.push_back(workers_.front().get());
}

std::unique_ptr<PartWorker> PartWorkers::make_worker() const {
  return std::unique_ptr<PartWorker>(new PartWorker{
      Measurer(*surface_, *graph_, tolerance_, *context_, rules_), Cutter(*surface_, *weights_), {}});
}

std::vector<TaskOutcome> PartWorkers::run(std::span<PartTask> tasks, MeasureMode mode, ValleyCache& known) {
  // The largest ones first, so that no thread is left alone with one of them at the end.
  std::vector<std::size_t> order(tasks.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) {
    return tasks[i].facets.size() > tasks[j].facets.size();
  });
  std::vector<TaskOutcome> outcomes(tasks.size());
  do_in_parallel(tasks.size(), *context_, [&](std::size_t n, const Context&) {
    run_one(tasks[order[n]], mode, known, outcomes[order[n]]);
  });
  for (TaskOutcome& outcome : outcomes) {
    known.absorb(outcome.found);
    outcome.found = ValleyCache();
  }
  return outcomes;
}

void PartWorkers::run_one(PartTask& task, MeasureMode mode, const ValleyCache& known, TaskOutcome& outcome) {
  context_->check();
  PartWorker* worker = nullptr;
  {
    const std::lock_guard lock(mutex_);
    if (idle_.empty()) {
      workers_.push_back(make_worker());
      idle_.push_back(workers_.back().get());
    }
    worker = idle_.back();
    idle_.pop_back();
  }
  // A worker that an error keeps isn't missed: the error ends everything.
  Measurer& measurer = worker->measurer;
  Measurement& measurement = worker->measurement;
  measurer.use_valleys(ValleyCache(), &known);
  if (task.hull) {
    measurer.measure_with_hull(task.facets, std::move(*task.hull), mode, measurement);
    task.hull.reset();
  } else {
    measurer.measure(task.facets, {}, mode, measurement);
  }
  outcome.concavity = measurement.concavity;
  if (measurement.concavity > measurer.tolerance()) {
    divide(*worker, task.depth, outcome);
  }
  outcome.found = measurer.take_valleys();
  outcome.hull = std::move(measurement.hull);
  const std::lock_guard lock(mutex_);
  idle_.push_back(worker);
}

}  // namespace ridgecraft::segment
