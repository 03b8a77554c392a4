// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/interruption.hpp"

#include <cerrno>
#include <exception>
#include <system_error>

#include <pthread.h>

namespace ridgecraft::cli {
namespace {

/// Wakes the waiter at the end of a job. Nothing happens where somebody else sends it: by default it's
/// ignored.
constexpr int wake_up = SIGURG;

/// How long the stages have to end by themselves after a signal: half a second.
constexpr timespec grace{0, 500'000'000};

/// For signal handlers, where no thread could be had.
// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables): a handler knows nothing else
Interruption* without_thread = nullptr;

}  // namespace

Interruption::Interruption(PendingFiles& pending) : pending_(pending), failures_(std::uncaught_exceptions()) {
  signals_ = interrupting_signals();
  sigset_t blocked = signals_;
  sigaddset(&blocked, wake_up);
  pthread_sigmask(SIG_BLOCK, &blocked, &previous_);
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
    pthread_kill(waiter_.native_handle(), wake_up);
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
  // A job that failed tells why. One that came to its end may have looked before the signal came.
  if (stopped().stop_requested() && std::uncaught_exceptions() == failures_) {
    end_now();
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
  sigset_t heeded = signals_;
  sigaddset(&heeded, wake_up);
  for (int signal = -1; signal < 0 || signal == wake_up;) {
    signal = sigwaitinfo(&heeded, nullptr);
    if ((signal < 0 || signal == wake_up) && finished.stop_requested()) {
      return;
    }
  }
  user_.request_stop();
  sigset_t end;
  sigemptyset(&end);
  sigaddset(&end, wake_up);
  while (sigtimedwait(&end, nullptr, &grace) >= 0 || errno == EINTR) {
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
