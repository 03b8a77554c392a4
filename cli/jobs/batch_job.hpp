// SPDX-License-Identifier: GPL-3.0-or-later
// ridgecraft batch: one verb for many models, each in a process of its own, and a report.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <string>

#include "cli/arguments/options.hpp"

namespace ridgecraft::cli {

struct BatchResult {
  std::size_t models = 0;            ///< of this shard
  std::size_t done_before = 0;       ///< by an earlier run that this one goes on with
  std::map<int, std::size_t> codes;  ///< how many ended with each exit code
  std::string report;
  int signal = 0;  ///< that ended it, or 0
};

/// Does all of it; the report has a line for each model then, in the order of the list. `progress` is called
/// with the share done. Throws Error for what concerns the whole; what happens to a model is in its line.
[[nodiscard]] BatchResult run_batch(const BatchJob& job, const std::function<void(double share)>& progress);

}  // namespace ridgecraft::cli
