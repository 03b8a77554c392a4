// SPDX-License-Identifier: GPL-3.0-or-later
// Ctrl-C while a job runs, and the end of the time given: the work is asked to stop. After Ctrl-C it is ended
// if it doesn't.
#pragma once

#include <array>
#include <chrono>
#include <csignal>
#include <optional>
#include <stop_token>
#include <thread>

#include "cli/early_end.hpp"
#include "cli/files/pending_files.hpp"

namespace ridgecraft::cli {

/// While it lives, SIGINT, SIGTERM and SIGHUP set the stop tokens. Stages look at them often; where a library
/// call can't be stopped, the program removes its temporary files and ends by itself half a second later,
/// with exit code 130. Where no thread can be had for that, signal handlers set the tokens, and the program
/// ends when its stages look at them. Signals that wait when it goes are heeded as before it came
/// (early_end.hpp).
class Interruption {
 public:
  struct Setup {
    std::optional<double> time_limit_s;  ///< from now on
    double segmentation_share = 1.0;     ///< of the limit
  };

  Interruption(PendingFiles& pending, const Setup& setup);
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;
  ~Interruption();

  /// Set by the user only.
  [[nodiscard]] std::stop_token stopped() const { return user_.get_token(); }
  /// Set by the user or when the time limit has passed.
  [[nodiscard]] std::stop_token time_up() const { return limit_.get_token(); }
  /// Set by the user or when the segmentation's share of it has.
  [[nodiscard]] std::stop_token segmentation_up() const { return segmentation_.get_token(); }

  using Clock = std::chrono::steady_clock;
  /// When the time limit passes; none where there is no limit.
  [[nodiscard]] std::optional<Clock::time_point> deadline() const { return limit_time_; }

 private:
  void wait_for_signal(const std::stop_token& finished);
  void wait_with_handlers();
  static void handle(int signal);
  void stop_all();
  void stop_what_is_due();
  [[noreturn]] void end_now();

  PendingFiles& pending_;
  std::optional<Clock::time_point> limit_time_;
  std::optional<Clock::time_point> segmentation_time_;
  std::stop_source user_;
  std::stop_source limit_;
  std::stop_source segmentation_;
  sigset_t signals_{};
  sigset_t previous_{};
  std::array<struct sigaction, interrupting.size()> before_{};  ///< where there is no thread
  std::jthread waiter_;
};

}  // namespace ridgecraft::cli
