// SPDX-License-Identifier: GPL-3.0-or-later
// Ctrl-C while a job runs: the work is asked to stop, and ended if it doesn't.
#pragma once

#include <array>
#include <csignal>
#include <stop_token>
#include <thread>

#include "base/stop.hpp"
#include "cli/early_end.hpp"
#include "cli/files/set/pending_files.hpp"

namespace ridgecraft::cli {

/// While it lives, SIGINT, SIGTERM and SIGHUP set the stop token. Stages look at it often; where a library
/// call can't be stopped, the program removes its temporary files and ends by itself half a second later,
/// with exit code 130. Where no thread can be had for that, signal handlers set the token, and the program
/// ends when its stages look at it. When it goes, a signal that nobody has looked for ends the program,
/// unless an exception is under way: then the job has failed, and that is told. Signals that come later are
/// heeded as before it came (early_end.hpp).
class Interruption {
 public:
  explicit Interruption(PendingFiles& pending);
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;
  ~Interruption();

  /// Set when a signal came.
  [[nodiscard]] StopToken stopped() const { return user_.get_token(); }

 private:
  void wait_for_signal(const std::stop_token& finished);
  void wait_with_handlers();
  static void handle(int signal);
  [[noreturn]] void end_now();

  PendingFiles& pending_;
  int failures_;  ///< exceptions under way when it came
  StopSource user_;
  sigset_t signals_{};
  sigset_t previous_{};
  std::array<struct sigaction, interrupting.size()> before_{};  ///< where there is no thread
  std::jthread waiter_;
};

}  // namespace ridgecraft::cli
