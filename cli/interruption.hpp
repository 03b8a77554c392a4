// SPDX-License-Identifier: GPL-3.0-or-later
// Ctrl-C while a job runs: the work is asked to stop, and ended if it doesn't.
#pragma once

#include <array>
#include <atomic>
#include <csignal>

#include "base/context.hpp"

namespace ridgecraft::cli {

/// While it lives, SIGINT, SIGTERM and SIGHUP set the stop token, which stages look at often, and end the
/// program with exit code 130 where it is still there a second later. Signals that are ignored when it comes
/// (nohup, a job in the background) stay ignored. At most one lives at a time.
class Interruption {
 public:
  /// `json`: a program that is ended so prints an object on standard output, too.
  explicit Interruption(bool json);
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;
  ~Interruption();

  /// Set when a signal came.
  [[nodiscard]] StopToken stopped() const { return source_.get_token(); }
  /// From now on the result is printed: the object is left out, and the sentence tells of the files.
  void work_is_done(bool files_written) noexcept;

 private:
  static constexpr std::array signals{SIGINT, SIGTERM, SIGHUP, SIGALRM};

  static void handle(int signal);
  [[noreturn]] void end() const noexcept;

  StopSource source_;
  std::atomic<bool> json_;
  std::atomic<bool> files_written_ = false;
  std::array<struct sigaction, signals.size()> before_{};
};

}  // namespace ridgecraft::cli
