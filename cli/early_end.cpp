// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/early_end.hpp"

#include <atomic>

#include <unistd.h>

#include "cli/telling/exit_code.hpp"

namespace ridgecraft::cli {
namespace {

// Set without code at the program's start, and safe to read in a signal handler.
// NOLINTBEGIN(cppcoreguidelines-avoid-non-const-global-variables): a handler knows nothing else
constinit std::atomic<bool> tells_json{false};
constinit std::atomic<bool> tells_of_files{false};
// NOLINTEND(cppcoreguidelines-avoid-non-const-global-variables)
static_assert(std::atomic<bool>::is_always_lock_free);

void write_all(int file, std::string_view text) noexcept {
  [[maybe_unused]] const ssize_t ignored = ::write(file, text.data(), text.size());
}

void handle(int /*signal*/) {
  end_interrupted();
}

}  // namespace

void end_at_signals(bool json) noexcept {
  tells_json = json;
  struct sigaction action {};
  action.sa_handler = handle;
  action.sa_flags = SA_RESTART;
  const sigset_t signals = interrupting_signals();
  for (const int signal : interrupting) {
    if (sigismember(&signals, signal) == 1) {
      sigaction(signal, &action, nullptr);
    }
  }
}

void files_are_written() noexcept {
  tells_of_files = true;
}

void json_is_printed() noexcept {
  tells_json = false;
}

void end_interrupted() noexcept {
  const bool written = tells_of_files;
  write_all(STDERR_FILENO, written ? "\nridgecraft: interrupted after the files were written\n"
                                   : "\nridgecraft: interrupted; nothing was written\n");
  if (tells_json) {
    write_all(
        STDOUT_FILENO,
        written ? "{\"error\": {\"code\": 130, \"message\": \"interrupted after the files were written\"}}\n"
                : "{\"error\": {\"code\": 130, \"message\": \"interrupted; nothing was written\"}}\n");
  }
  ::_exit(static_cast<int>(ExitCode::interrupted));
}

sigset_t interrupting_signals() noexcept {
  sigset_t signals;
  sigemptyset(&signals);
  for (const int signal : interrupting) {
    struct sigaction action {};
    if (sigaction(signal, nullptr, &action) == 0 && action.sa_handler != SIG_IGN) {
      sigaddset(&signals, signal);
    }
  }
  return signals;
}

}  // namespace ridgecraft::cli
