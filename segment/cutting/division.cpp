// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/cutting/division.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/parallel.hpp"

namespace ridgecraft::segment {
namespace {

/// From this depth on parts are halved, so that no input makes the recursion linear
/// (docs/design/segmentation.md, "Where nothing is cut").
constexpr int deepest_cut = 60;
/// A worker's arrays cost up to a twentieth of the time that one thread takes for the whole surface: one more
/// is made for each such part of the surface that there is to do.
constexpr std::size_t workers_for_surface = 16;

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

PartWorkers::PartWorkers(const ScaledSurface& surface, const VertexGraph& graph, const EdgeWeights& weights,
                         const MeasureRules& by, const Context& context)
    : surface_(&surface), graph_(&graph), weights_(&weights), context_(&context), rules_(by) {
  workers_.push_back(make_worker());
  idle_.push_back(workers_.front().get());
}

std::unique_ptr<PartWorker> PartWorkers::make_worker() const {
  return std::unique_ptr<PartWorker>(
      new PartWorker{Measurer(*surface_, *graph_, rules_, *context_), Cutter(*surface_, *weights_), {}});
}

unsigned PartWorkers::threads_for(std::span<const PartTask> tasks) const {
  std::size_t facets = 0;
  for (const PartTask& task : tasks) {
    facets += task.facets.size();
  }
  const std::size_t worthwhile =
      1 + facets * workers_for_surface / std::max<std::size_t>(surface_->facet_count(), 1);
  return static_cast<unsigned>(
      std::min<std::size_t>(context_->threads, std::max(workers_.size(), worthwhile)));
}

std::vector<TaskOutcome> PartWorkers::run(std::span<PartTask> tasks, const MeasureOptions& options,
                                          ValleyCache& known,
                                          const std::function<void(double facets)>& progress) {
  // The largest ones first, so that no thread is left alone with one of them at the end.
  std::vector<std::size_t> order(tasks.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) {
    return tasks[i].facets.size() > tasks[j].facets.size();
  });
  std::vector<TaskOutcome> outcomes(tasks.size());
  Context context = *context_;
  context.threads = threads_for(tasks);
  std::atomic<double> facets = 0.0;
  do_in_parallel(
      tasks.size(), context,
      [&](std::size_t n, const Context&) {
        PartTask& task = tasks[order[n]];
        TaskOutcome& outcome = outcomes[order[n]];
        run_one(task, options, known, outcome);
        const int halvings = outcome.pieces.empty() ? task.depth : task.depth + 1;
        facets += std::ldexp(static_cast<double>(task.facets.size()), -halvings);
      },
      [&](std::size_t) { progress(facets); });
  for (TaskOutcome& outcome : outcomes) {
    known.absorb(outcome.found);
    outcome.found = ValleyCache();
  }
  return outcomes;
}

PartWorker* PartWorkers::take_worker() {
  {
    const std::lock_guard lock(mutex_);
    if (!idle_.empty()) {
      PartWorker* worker = idle_.back();
      idle_.pop_back();
      return worker;
    }
  }
  // Outside the lock: the arrays take time, and the others needn't wait for them.
  std::unique_ptr<PartWorker> made = make_worker();
  const std::lock_guard lock(mutex_);
  return workers_.emplace_back(std::move(made)).get();
}

void PartWorkers::run_one(PartTask& task, const MeasureOptions& options, const ValleyCache& known,
                          TaskOutcome& outcome) {
  context_->check();
  PartWorker* worker = take_worker();
  // A worker that an error keeps isn't missed: the error ends everything.
  run_with(*worker, task, options, known, outcome);
  const std::lock_guard lock(mutex_);
  idle_.push_back(worker);
}

void PartWorkers::run_with(PartWorker& worker, PartTask& task, const MeasureOptions& options,
                           const ValleyCache& known, TaskOutcome& outcome) const {
  Measurer& measurer = worker.measurer;
  Measurement& measurement = worker.measurement;
  const ValleyLoan loan(measurer.valleys(), outcome.found, &known);
  if (task.hull) {
    measurer.measure_with_hull(task.facets, std::move(*task.hull), options, measurement);
    task.hull.reset();
  } else {
    measurer.measure(task.facets, {}, options, measurement);
  }
  outcome.concavity = measurement.concavity;
  if (measurement.concavity > measurer.tolerance()) {
    divide(worker, task.depth, outcome);
  }
  outcome.hull = std::move(measurement.hull);
}

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
