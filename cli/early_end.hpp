// SPDX-License-Identifier: GPL-3.0-or-later
// Ctrl-C while no job runs: before it has begun and after it has ended. (While it runs: interruption.hpp.)
#pragma once

#include <array>
#include <csignal>
#include <string_view>

namespace ridgecraft::cli {

/// What users, terminals and systems end programs with.
inline constexpr std::array interrupting{SIGINT, SIGTERM, SIGHUP};

/// True where the words of a command line ask for JSON: options end at "--".
template <class Words>
[[nodiscard]] bool asks_for_json(const Words& words) {
  for (const std::string_view word : words) {
    if (word == "--json" || word == "--") {
      return word == "--json";
    }
  }
  return false;
}

/// From now on SIGINT, SIGTERM and SIGHUP end the program at once, with exit code 130 and the sentence that
/// nothing was written, and with `json` also with that as an object on standard output. Signals that are
/// ignored (nohup, a job in the background) stay ignored. May be called before main().
void end_at_signals(bool json) noexcept;

/// From now on the sentence says that the files were written.
void files_are_written() noexcept;
/// From now on the object is left out: the job's own was printed.
void json_is_printed() noexcept;

/// Ends the program with the sentence. Safe in signal handlers; nothing is cleaned up.
[[noreturn]] void end_interrupted() noexcept;

/// All of `interrupting` but for those that are ignored.
[[nodiscard]] sigset_t interrupting_signals() noexcept;

}  // namespace ridgecraft::cli
