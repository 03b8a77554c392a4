// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/interruption.hpp"

#include <array>
#include <string_view>
#include <system_error>

#include <pthread.h>
#include <sys/time.h>
#include <unistd.h>

#include "cli/exit_code.hpp"

namespace ridgecraft::cli {
namespace {

constexpr std::array interrupting{SIGINT, SIGTERM, SIGHUP};
constexpr long tick_us = 20'000;

/// For signal handlers, where no thread could be had.
Interruption* without_thread = nullptr;

void write_all(int file, std::string_view text) {
  [[maybe_unused]] const ssize_t ignored = ::write(file, text.data(), text.size());
}

}  // namespace

Interruption::Interruption(PendingFiles& pending, const Setup& setup) : pending_(pending), json_(setup.json) {
  if (setup.time_limit_s) {
    const auto after = [start = Clock::now()](double seconds) {
      return start + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
    };
    limit_time_ = after(*setup.time_limit_s);
    segmentation_time_ = after(*setup.time_limit_s * setup.segmentation_share);
  }
  sigemptyset(&signals_);
  for (const int signal : interrupting) {
    struct sigaction action {};
    // A signal that is ignored (nohup, a job in the background) stays ignored.
    if (sigaction(signal, nullptr, &action) == 0 && action.sa_handler != SIG_IGN) {
      sigaddset(&signals_, signal);
    }
  }
  pthread_sigmask(SIG_BLOCK, &signals_, &previous_);
  try {
    waiter_ = std::jthread([this](const std::stop_token& finished) { wait_for_signal(finished); });
  } catch (const std::system_error&) {
    pthread_sigmask(SIG_SETMASK, &previous_, nullptr);
    wait_with_handlers();
  }
}

Interruption::~Interruption() {
  if (waiter_.joinable()) {
    waiter_.request_stop();
    waiter_.join();
    pthread_sigmask(SIG_SETMASK, &previous_, nullptr);
  } else {
    const itimerval never{};
    setitimer(ITIMER_REAL, &never, nullptr);
    for (const int signal : interrupting) {
      if (sigismember(&signals_, signal) == 1) {
        std::signal(signal, SIG_DFL);
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
  for (const int signal : interrupting) {
    if (sigismember(&signals_, signal) == 1) {
      sigaction(signal, &action, nullptr);
    }
  }
  if (limit_time_) {
    sigaction(SIGALRM, &action, nullptr);
    const itimerval often{{0, tick_us}, {0, tick_us}};
    setitimer(ITIMER_REAL, &often, nullptr);
  }
}

/// Nothing but atomic variables is touched: the stop sources have no callbacks.
void Interruption::handle(int signal) {
  if (without_thread == nullptr) {
    return;
  }
  if (signal == SIGALRM) {
    without_thread->stop_what_is_due();
  } else {
    without_thread->stop_all();
  }
}

void Interruption::stop_all() {
  user_.request_stop();
  limit_.request_stop();
  segmentation_.request_stop();
}

void Interruption::stop_what_is_due() {
  const auto now = Clock::now();
  if (segmentation_time_ && now >= *segmentation_time_) {
    segmentation_.request_stop();
  }
  if (limit_time_ && now >= *limit_time_) {
    limit_.request_stop();
  }
}

void Interruption::wait_for_signal(const std::stop_token& finished) {
  using namespace std::chrono_literals;
  constexpr timespec tick{0, 1000 * tick_us};
  while (sigtimedwait(&signals_, nullptr, &tick) < 0) {
    if (finished.stop_requested()) {
      return;
    }
    stop_what_is_due();
  }
  stop_all();
  for (int i = 0; i < 25; ++i) {
    std::this_thread::sleep_for(20ms);
    if (finished.stop_requested()) {
      return;
    }
  }
  end_now();
}

void Interruption::end_now() {
  const bool written = pending_.discard();
  write_all(STDERR_FILENO, written ? "\nridgecraft: interrupted after the files were written\n"
                                   : "\nridgecraft: interrupted; nothing was written\n");
  if (json_) {
    write_all(
        STDOUT_FILENO,
        written ? "{\"error\": {\"code\": 130, \"message\": \"interrupted after the files were written\"}}\n"
                : "{\"error\": {\"code\": 130, \"message\": \"interrupted; nothing was written\"}}\n");
  }
  ::_exit(static_cast<int>(ExitCode::interrupted));
}

}  // namespace ridgecraft::cli
