// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/interruption.hpp"

#include <string_view>

#include <unistd.h>

#include "cli/report/messages.hpp"

namespace ridgecraft::cli {
namespace {

/// Between the signal and the end of a program that doesn't stop by itself.
constexpr unsigned grace_s = 1;

// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables): a handler knows nothing else
constinit std::atomic<Interruption*> current = nullptr;
static_assert(std::atomic<Interruption*>::is_always_lock_free && std::atomic<bool>::is_always_lock_free);

void print(int file, std::string_view text) noexcept {
  [[maybe_unused]] const ssize_t ignored = ::write(file, text.data(), text.size());
}

}  // namespace

Interruption::Interruption(bool json) : json_(json) {
  current = this;
  struct sigaction action {};
  action.sa_handler = handle;
  action.sa_flags = SA_RESTART;
  for (std::size_t i = 0; i < signals.size(); ++i) {
    sigaction(signals[i], nullptr, &before_[i]);
    if (before_[i].sa_handler != SIG_IGN || signals[i] == SIGALRM) {
      sigaction(signals[i], &action, nullptr);
    }
  }
}

Interruption::~Interruption() {
  // The alarm last: until then a signal may set it, and its usual action ends the program.
  static_assert(signals.back() == SIGALRM);
  for (std::size_t i = 0; i + 1 < signals.size(); ++i) {
    sigaction(signals[i], &before_[i], nullptr);
  }
  ::alarm(0);
  sigaction(SIGALRM, &before_.back(), nullptr);
  current = nullptr;
}

void Interruption::work_is_done(bool files_written) noexcept {
  json_ = false;
  files_written_ = files_written;
}

/// Only calls what is safe in signal handlers: the stop source has no callbacks.
void Interruption::handle(int signal) {
  Interruption* const job = current;
  if (job == nullptr) {
    return;
  }
  if (signal == SIGALRM) {
    job->end();
  }
  job->source_.request_stop();
  ::alarm(grace_s);
}

void Interruption::end() const noexcept {
  print(STDERR_FILENO, files_written_ ? "\nridgecraft: interrupted after the files were written\n"
                                      : "\nridgecraft: interrupted before the work was done\n");
  if (json_) {
    print(STDOUT_FILENO,
          "{\"error\": {\"code\": 130, \"message\": \"interrupted before the work was done\"}}\n");
  }
  ::_exit(static_cast<int>(ExitCode::interrupted));
}

}  // namespace ridgecraft::cli
