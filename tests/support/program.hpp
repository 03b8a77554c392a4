// SPDX-License-Identifier: GPL-3.0-or-later
// The finished program, run as a user would.
#pragma once

#include <csignal>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <sys/types.h>

namespace ridgecraft::test {

struct Outcome {
  int exit_code = -1;  ///< 128 + signal where a signal ended it
  bool by_signal = false;
  std::string out;
  std::string err;
  double seconds = 0.0;      ///< of the clock
  double cpu_seconds = 0.0;  ///< of the processor
};

struct RunOptions {
  std::filesystem::path folder = ".";             ///< working folder
  std::optional<std::filesystem::path> out_file;  ///< standard output goes there instead
  std::optional<unsigned long> largest_file;      ///< RLIMIT_FSIZE, bytes
  std::optional<double> interrupt_after_s;        ///< a signal then, ...
  int signal = SIGINT;                            ///< ... this one; ...
  bool when_heeded = false;              ///< ... counted from where the program catches or ignores it, ...
  std::function<bool()> interrupt_from;  ///< ... and from where this is true, asked every millisecond
  std::function<bool()> kill_when;       ///< asked every 0.1 ms: SIGKILL as soon as it is true
  std::optional<unsigned long> most_threads;  ///< RLIMIT_NPROC, as a user of its own; only for root
  bool as_nobody = false;                     ///< without root's rights, where root runs the tests
};

/// Runs `ridgecraft` with these arguments and waits for its end.
[[nodiscard]] Outcome run_program(const std::vector<std::string>& arguments, const RunOptions& options = {});

/// Runs any command; the first word is looked up on the path.
[[nodiscard]] Outcome run_command(const std::vector<std::string>& command, const RunOptions& options = {});

/// True where as_nobody has a meaning: root runs the tests, and nobody may reach the program.
[[nodiscard]] bool can_drop_rights();

}  // namespace ridgecraft::test
