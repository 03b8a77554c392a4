// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/interruption.hpp"

#include <chrono>
#include <string_view>

#include <pthread.h>
#include <unistd.h>

#include "cli/exit_code.hpp"

namespace ridgecraft::cli {

Interruption::Interruption(PendingFiles& pending) : pending_(pending) {
  sigemptyset(&signals_);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction action {};
    // A signal that is ignored (nohup, a job in the background) stays ignored.
    if (sigaction(signal, nullptr, &action) == 0 && action.sa_handler != SIG_IGN) {
      sigaddset(&signals_, signal);
    }
  }
  pthread_sigmask(SIG_BLOCK, &signals_, &previous_);
  waiter_ = std::jthread([this](const std::stop_token& finished) { wait_for_signal(finished); });
}

Interruption::~Interruption() {
  waiter_.request_stop();
  waiter_.join();
  pthread_sigmask(SIG_SETMASK, &previous_, nullptr);
}

void Interruption::wait_for_signal(const std::stop_token& finished) {
  using namespace std::chrono_literals;
  constexpr timespec tick{0, 20'000'000};
  while (sigtimedwait(&signals_, nullptr, &tick) < 0) {
    if (finished.stop_requested()) {
      return;
    }
  }
  source_.request_stop();
  for (int i = 0; i < 25; ++i) {
    std::this_thread::sleep_for(20ms);
    if (finished.stop_requested()) {
      return;
    }
  }
  const std::string_view sentence = pending_.discard()
                                        ? "\nridgecraft: interrupted after the files were written\n"
                                        : "\nridgecraft: interrupted; nothing was written\n";
  [[maybe_unused]] const ssize_t ignored = ::write(STDERR_FILENO, sentence.data(), sentence.size());
  ::_exit(static_cast<int>(ExitCode::interrupted));
}

}  // namespace ridgecraft::cli
