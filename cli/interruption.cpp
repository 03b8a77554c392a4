// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/interruption.hpp"

#include <chrono>
#include <system_error>

#include <pthread.h>

namespace ridgecraft::cli {
namespace {

constexpr long tick_us = 20'000;

/// For signal handlers, where no thread could be had.
Interruption* without_thread = nullptr;

}  // namespace

Interruption::Interruption(PendingFiles& pending) : pending_(pending) {
  signals_ = interrupting_signals();
  pthread_sigmask(SIG_BLOCK, &signals_, &previous_);
  try {
    waiter_ = std::jthread([this](const std::stop_token& finished) { wait_for_signal(finished); });
  } catch (const std::system_error&) {
    wait_with_handlers();
    pthread_sigmask(SIG_SETMASK, &previous_, nullptr);
  }
}

Interruption::~Interruption() {
  if (waiter_.joinable()) {
    waiter_.request_stop();
    waiter_.join();
    pthread_sigmask(SIG_SETMASK, &previous_, nullptr);
  } else {
    for (std::size_t i = 0; i < interrupting.size(); ++i) {
      if (sigismember(&signals_, interrupting[i]) == 1) {
        sigaction(interrupting[i], &before_[i], nullptr);
      }
    }
    without_thread = nullptr;
  }
}

void Interruption::wait_with_handlers() {
  without_thread = this;
  struct sigaction action {};
  action.sa_handler = handle;
  action.sa_flags = SA_RESTART;
  for (std::size_t i = 0; i < interrupting.size(); ++i) {
    if (sigismember(&signals_, interrupting[i]) == 1) {
      sigaction(interrupting[i], &action, &before_[i]);
    }
  }
}

/// Nothing but atomic variables is touched: the stop source has no callbacks.
void Interruption::handle(int /*signal*/) {
  if (without_thread != nullptr) {
    without_thread->user_.request_stop();
  }
}

void Interruption::wait_for_signal(const std::stop_token& finished) {
  using namespace std::chrono_literals;
  constexpr timespec tick{0, 1000 * tick_us};
  while (sigtimedwait(&signals_, nullptr, &tick) < 0) {
    if (finished.stop_requested()) {
      return;
    }
  }
  user_.request_stop();
  for (int i = 0; i < 25; ++i) {
    std::this_thread::sleep_for(20ms);
    if (finished.stop_requested()) {
      return;
    }
  }
  end_now();
}

void Interruption::end_now() {
  if (pending_.discard()) {
    files_are_written();
  }
  end_interrupted();
}

}  // namespace ridgecraft::cli
