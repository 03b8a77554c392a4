// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/jobs/worker.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <utility>

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/error.hpp"

namespace ridgecraft::cli {
namespace {

using Clock = std::chrono::steady_clock;

/// A process that doesn't end at its time limit is given this many seconds, and a share of the limit.
constexpr double grace_s = 2.0;
constexpr double grace_share = 0.2;

/// A file without name, which both processes hold.
class Output {
 public:
  Output() : file_(std::tmpfile()) {
    if (file_ == nullptr) {
      throw Error(ErrorKind::cant_write, "there is no place for temporary files");
    }
  }
  Output(const Output&) = delete;
  Output& operator=(const Output&) = delete;
  Output(Output&& other) noexcept : file_(std::exchange(other.file_, nullptr)) {}
  Output& operator=(Output&& other) = delete;
  ~Output() {
    if (file_ != nullptr) {
      std::fclose(file_);
    }
  }

  [[nodiscard]] int descriptor() const { return ::fileno(file_); }
  [[nodiscard]] std::string text() const {
    std::string text;
    if (std::fseek(file_, 0, SEEK_SET) != 0) {
      return text;
    }
    std::array<char, 4096> buffer{};
    for (std::size_t n = 0; (n = std::fread(buffer.data(), 1, buffer.size(), file_)) > 0;) {
      text.append(buffer.data(), n);
    }
    return text;
  }

 private:
  std::FILE* file_;
};

struct Running {
  std::size_t task = 0;
  Output out;
  Output err;
  Clock::time_point start = Clock::now();
  bool out_of_time = false;
};

/// The signals that a batch waits for instead of being interrupted by them.
class HeldSignals {
 public:
  HeldSignals() {
    sigemptyset(&set_);
    for (const int signal : {SIGCHLD, SIGINT, SIGTERM, SIGHUP}) {
      sigaddset(&set_, signal);
    }
    sigprocmask(SIG_BLOCK, &set_, &before_);
  }
  HeldSignals(const HeldSignals&) = delete;
  HeldSignals& operator=(const HeldSignals&) = delete;
  ~HeldSignals() { sigprocmask(SIG_SETMASK, &before_, nullptr); }

  void give_back() const { sigprocmask(SIG_SETMASK, &before_, nullptr); }
  /// The next one, or 0 after this time.
  [[nodiscard]] int wait(std::chrono::nanoseconds time) const {
    timespec limit{};
    limit.tv_sec = static_cast<time_t>(std::chrono::duration_cast<std::chrono::seconds>(time).count());
    limit.tv_nsec = static_cast<long>((time % std::chrono::seconds(1)).count());
    const int signal = sigtimedwait(&set_, nullptr, &limit);
    return signal > 0 ? signal : 0;
  }

 private:
  sigset_t set_{};
  sigset_t before_{};
};

/// In the new process, where nothing may be allocated.
[[noreturn]] void become(std::vector<char*>& words, const Running& running, const WorkerLimits& limits,
                         const HeldSignals& held, pid_t parent) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) {
    ::_exit(EXIT_FAILURE);  // the batch has ended meanwhile
  }
  held.give_back();
  const int nothing = ::open("/dev/null", O_RDONLY);
  ::dup2(nothing, STDIN_FILENO);
  ::dup2(running.out.descriptor(), STDOUT_FILENO);
  ::dup2(running.err.descriptor(), STDERR_FILENO);
  if (limits.memory_bytes > 0) {
    const rlimit limit{limits.memory_bytes, limits.memory_bytes};
    ::setrlimit(RLIMIT_AS, &limit);
  }
  const rlimit no_core{0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  ::execv("/proc/self/exe", words.data());
  ::_exit(EXIT_FAILURE);
}

class Workers {
 public:
  Workers(const WorkerLimits& limits, const HeldSignals& held) : limits_(limits), held_(held) {}
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;
  ~Workers() { end_all(); }

  [[nodiscard]] std::size_t count() const { return running_.size(); }

  void start(std::size_t task, const std::vector<std::string>& words) {
    std::vector<std::string> copy{"ridgecraft"};
    copy.insert(copy.end(), words.begin(), words.end());
    std::vector<char*> pointers;
    for (std::string& word : copy) {
      pointers.push_back(word.data());
    }
    pointers.push_back(nullptr);
    Running running{.task = task, .out = {}, .err = {}};
    const pid_t parent = ::getpid();
    const pid_t child = ::fork();
    if (child == -1) {
      throw Error(ErrorKind::cant_write, "no process could be started for a model");
    }
    if (child == 0) {
      become(pointers, running, limits_, held_, parent);
    }
    running_.emplace(child, std::move(running));
  }

  /// Those that have ended.
  void collect(const std::function<void(const WorkerEnd&)>& done) {
    int status = 0;
    rusage used{};
    for (pid_t child = 0; (child = ::wait4(-1, &status, WNOHANG, &used)) > 0;) {
      const auto at = running_.find(child);
      if (at == running_.end()) {
        continue;
      }
      const Running& running = at->second;
      const bool by_signal = WIFSIGNALED(status);
      WorkerEnd end{.task = running.task,
                    .exit_code = by_signal ? -1 : WEXITSTATUS(status),
                    .signal = by_signal ? WTERMSIG(status) : 0,
                    .out_of_time = running.out_of_time,
                    .seconds = std::chrono::duration<double>(Clock::now() - running.start).count(),
                    .peak_bytes = static_cast<std::uint64_t>(used.ru_maxrss) * 1024,
                    .out = running.out.text(),
                    .err = running.err.text()};
      running_.erase(at);
      done(end);
    }
  }

  /// Ends those whose time has passed; when the next one's will have.
  std::chrono::nanoseconds end_late_ones() {
    std::chrono::nanoseconds next = std::chrono::hours(1);
    if (!limits_.seconds) {
      return next;
    }
    const auto limit = std::chrono::duration_cast<std::chrono::nanoseconds>(
        std::chrono::duration<double>((1.0 + grace_share) * *limits_.seconds + grace_s));
    for (auto& [child, running] : running_) {
      const std::chrono::nanoseconds left = running.start + limit - Clock::now();
      if (left.count() <= 0 && !running.out_of_time) {
        running.out_of_time = true;
        ::kill(child, SIGKILL);
      } else if (!running.out_of_time) {
        next = std::min(next, left);
      }
    }
    return next;
  }

 private:
  void end_all() {
    for (const auto& [child, running] : running_) {
      ::kill(child, SIGKILL);
    }
    for (const auto& [child, running] : running_) {
      ::waitpid(child, nullptr, 0);
    }
  }

  WorkerLimits limits_;
  const HeldSignals& held_;
  std::map<pid_t, Running> running_;
};

}  // namespace

int run_workers(std::size_t tasks, unsigned jobs, const WorkerLimits& limits,
                const std::function<std::vector<std::string>(std::size_t)>& words,
                const std::function<void(const WorkerEnd&)>& done) {
  const HeldSignals held;
  Workers workers(limits, held);
  for (std::size_t next = 0; next < tasks || workers.count() > 0;) {
    while (next < tasks && workers.count() < jobs) {
      workers.start(next, words(next));
      ++next;
    }
    const int signal = held.wait(workers.end_late_ones());
    if (signal != 0 && signal != SIGCHLD) {
      return signal;
    }
    workers.collect(done);
  }
  return 0;
}

}  // namespace ridgecraft::cli
