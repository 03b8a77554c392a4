// SPDX-License-Identifier: GPL-3.0-or-later
// Parts are divided, round by round and on several threads, until all are within the tolerance.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "segment/concavity/measure.hpp"
#include "segment/cutting/cut.hpp"
#include "segment/surface/segmentation.hpp"

namespace ridgecraft::segment {

// Parts that are measured, and divided where they are too concave, on several threads.

/// A part that is to be measured.
struct PartTask {
  Facets facets;
  int depth = 0;  ///< cuts that it came from
  PartReason reason = PartReason::component;
  std::optional<Hull> hull = std::nullopt;  ///< where it is known
};

/// What came of it.
struct TaskOutcome {
  double concavity = 0.0;
  Hull hull;
  std::vector<Facets> pieces;  ///< two at least, ascending, of a part that is too concave; else none
  bool cut = false;            ///< between ridges; else divided by the nearer end of the deepest bridge
  bool halved = false;         ///< into halves, because cutting had gone on too long
  ValleyCache found;
};

/// What one thread needs to measure and cut: arrays for the whole surface.
struct PartWorker {
  Measurer measurer;
  Cutter cutter;
  Measurement measurement;
};

/// As many workers as were at work at the same time: at most one for each thread, each task of the largest
/// round and each sixteenth of the surface.
class PartWorkers {
 public:
  /// All must outlive this, but for the rules.
  PartWorkers(const ScaledSurface& surface, const VertexGraph& graph, const EdgeWeights& weights,
              const MeasureRules& by, const Context& context);

  /// The one for work that isn't divided; not while run() is running.
  [[nodiscard]] PartWorker& first() { return *workers_.front(); }
  [[nodiscard]] const ScaledSurface& surface() const { return *surface_; }

  /// Measures all parts and divides those that are too concave. Each task uses the same valleys, `known`, and
  /// those that it finds itself; afterwards all found ones are among the known, in the order of the tasks. So
  /// neither the number of threads nor their speed enters the result. Takes the hulls out of the tasks.
  /// `progress` is called after each task, from one thread at a time, with a number that never falls: the
  /// facets that this round has done. Those of a part that was divided count for half of what was left to do
  /// of them, so over all rounds each facet counts for one.
  std::vector<TaskOutcome> run(std::span<PartTask> tasks, const MeasureOptions& options, ValleyCache& known,
                               const std::function<void(double facets)>& progress);

 private:
  [[nodiscard]] std::unique_ptr<PartWorker> make_worker() const;
  [[nodiscard]] unsigned threads_for(std::span<const PartTask> tasks) const;
  /// An idle worker, or a new one.
  [[nodiscard]] PartWorker* take_worker();
  void run_one(PartTask& task, const MeasureOptions& options, const ValleyCache& known, TaskOutcome& outcome);
  /// All that is lent to the worker is back when this returns: only then may another thread take it.
  void run_with(PartWorker& worker, PartTask& task, const MeasureOptions& options, const ValleyCache& known,
                TaskOutcome& outcome) const;

  const ScaledSurface* surface_;
  const VertexGraph* graph_;
  const EdgeWeights* weights_;
  const Context* context_;
  MeasureRules rules_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<PartWorker>> workers_;
  std::vector<PartWorker*> idle_;
};

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
