// SPDX-License-Identifier: GPL-3.0-or-later
// Processes of a batch: whatever happens to one, the others go on.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace ridgecraft::cli {

/// What a process may take.
struct WorkerLimits {
  std::optional<double> seconds;   ///< it is ended a while after that: it stops by itself before
  std::uint64_t memory_bytes = 0;  ///< of address space; 0: as much as there is
};

/// How a process ended.
struct WorkerEnd {
  std::size_t task = 0;
  int exit_code = 0;  ///< -1 where a signal ended it
  int signal = 0;
  bool out_of_time = false;  ///< it had to be ended
  double seconds = 0.0;
  std::uint64_t peak_bytes = 0;
  std::string out;
  std::string err;
};

/// Runs this program with words for each task, at most `jobs` at a time, and calls done(end) for each in the
/// order in which they end. `words(task)` is asked for when its turn comes. Returns the signal that ended the
/// batch, or 0: SIGINT, SIGTERM and SIGHUP end all processes. One of them is ended with this process, too,
/// however that ends.
[[nodiscard]] int run_workers(std::size_t tasks, unsigned jobs, const WorkerLimits& limits,
                              const std::function<std::vector<std::string>(std::size_t task)>& words,
                              const std::function<void(const WorkerEnd& end)>& done);

}  // namespace ridgecraft::cli
