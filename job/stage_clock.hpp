// SPDX-License-Identifier: GPL-3.0-or-later
// How long the stages of a job take.
#pragma once

#include <chrono>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/context.hpp"

namespace ridgecraft::job {

/// Wall seconds per stage, in the order in which they began; a stage that is entered again adds to its own.
using StageSeconds = std::vector<std::pair<std::string, double>>;

/// Runs the stages of a job, and tells how long each took.
class StageClock {
 public:
  /// Runs a stage, reports it as progress, and takes its time. Throws Error(interrupted) where the user has
  /// stopped the job before, and whatever the stage throws.
  template <class Stage>
  auto operator()(std::string_view name, const Context& context, const Stage& stage) {
    context.check();
    context.report(name, 0.0);
    const auto start = std::chrono::steady_clock::now();
    auto result = stage();
    add(name, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    return result;
  }
  /// Takes over the stages of another clock.
  void add(const StageSeconds& seconds);
  [[nodiscard]] const StageSeconds& seconds() const { return seconds_; }

 private:
  void add(std::string_view name, double seconds);

  StageSeconds seconds_;
};

/// Of all stages together.
[[nodiscard]] double total(const StageSeconds& seconds);

}  // namespace ridgecraft::job
