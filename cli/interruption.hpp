// SPDX-License-Identifier: GPL-3.0-or-later
// Ctrl-C at any moment: the work is asked to stop, and ended if it doesn't.
#pragma once

#include <csignal>
#include <stop_token>
#include <thread>

#include "cli/pending_files.hpp"

namespace ridgecraft::cli {

/// While it lives, SIGINT, SIGTERM and SIGHUP set the stop token. Stages look at it often; where a library
/// call can't be stopped, the program removes its temporary files and ends by itself half a second later,
/// with exit code 130.
class Interruption {
 public:
  explicit Interruption(PendingFiles& pending);
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;
  ~Interruption();

  [[nodiscard]] std::stop_token token() const { return source_.get_token(); }

 private:
  void wait_for_signal(const std::stop_token& finished);

  PendingFiles& pending_;
  std::stop_source source_;
  sigset_t signals_{};
  sigset_t previous_{};
  std::jthread waiter_;
};

}  // namespace ridgecraft::cli
