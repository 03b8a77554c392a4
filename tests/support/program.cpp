// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/program.hpp"

#include <chrono>
#include <csignal>
#include <fstream>
#include <stdexcept>
#include <thread>

#include <fcntl.h>
#include <grp.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "support/temporary_folder.hpp"

namespace ridgecraft::test {
namespace {

constexpr uid_t nobody = 65534;
/// Has no other processes, which would count.
constexpr uid_t lonely = 61734;

[[noreturn]] void become(const std::vector<std::string>& command, const RunOptions& options,
                         const std::filesystem::path& out, const std::filesystem::path& err) {
  const int out_file = ::open(out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
  const int err_file = ::open(err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
  const int in_file = ::open("/dev/null", O_RDONLY);
  ::dup2(in_file, STDIN_FILENO);
  ::dup2(out_file, STDOUT_FILENO);
  ::dup2(err_file, STDERR_FILENO);
  if (options.largest_file) {
    const rlimit limit{*options.largest_file, *options.largest_file};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  if (options.most_threads) {
    const rlimit limit{*options.most_threads, *options.most_threads};
    ::setrlimit(RLIMIT_NPROC, &limit);
  }
  if ((options.as_nobody || options.most_threads) && ::geteuid() == 0) {
    const uid_t user = options.most_threads ? lonely : nobody;
    const bool dropped = ::setgroups(0, nullptr) == 0 && ::setgid(nobody) == 0 && ::setuid(user) == 0;
    if (!dropped) {
      ::_exit(126);
    }
  }
  if (::chdir(options.folder.c_str()) != 0) {
    ::_exit(126);
  }
  std::vector<char*> words;
  for (const std::string& word : command) {
    words.push_back(const_cast<char*>(word.c_str()));
  }
  words.push_back(nullptr);
  ::execvp(words[0], words.data());
  ::_exit(127);
}

/// From /proc: has the program that a child became a handler for this signal, does it ignore it, or has it
/// ended?
bool heeds_or_ended(pid_t process, int signal) {
  namespace fs = std::filesystem;
  const fs::path entry = "/proc/" + std::to_string(process);
  std::error_code error;
  if (fs::read_symlink(entry / "exe", error) == fs::read_symlink("/proc/self/exe", error) && !error) {
    return false;  // it is still a copy of the tests, with their handlers
  }
  std::ifstream status(entry / "status");
  for (std::string line; std::getline(status, line);) {
    const bool tells = line.starts_with("SigIgn:") || line.starts_with("SigCgt:");
    if (tells && (std::stoull(line.substr(7), nullptr, 16) >> static_cast<unsigned>(signal - 1) & 1U) != 0) {
      return true;
    }
    if (line.starts_with("SigCgt:")) {
      return false;
    }
    if (line.starts_with("State:") && line.find('Z') != std::string::npos) {
      return true;
    }
  }
  return true;
}

}  // namespace

Outcome run_command(const std::vector<std::string>& command, const RunOptions& options) {
  const TemporaryFolder scratch;
  const std::filesystem::path out = options.out_file ? *options.out_file : scratch / "out";
  const std::filesystem::path err = scratch / "err";
  // They are there before the child is: it may be killed before it opens them.
  if (!options.out_file) {
    write_bytes(out, "");
  }
  write_bytes(err, "");
  const auto start = std::chrono::steady_clock::now();
  const pid_t child = ::fork();
  if (child < 0) {
    throw std::runtime_error("can't start " + command.front());
  }
  if (child == 0) {
    become(command, options, out, err);
  }
  if (options.interrupt_after_s) {
    while (options.when_heeded && !heeds_or_ended(child, options.signal)) {
    }
    while (options.interrupt_from && !options.interrupt_from()) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    std::this_thread::sleep_for(std::chrono::duration<double>(*options.interrupt_after_s));
    ::kill(child, options.signal);
  }
  int status = 0;
  rusage used{};
  if (options.kill_when) {
    while (::wait4(child, &status, WNOHANG, &used) == 0) {
      if (options.kill_when()) {
        ::kill(child, SIGKILL);
        ::wait4(child, &status, 0, &used);
        break;
      }
      std::this_thread::sleep_for(std::chrono::microseconds(100));
    }
  } else {
    ::wait4(child, &status, 0, &used);
  }
  Outcome outcome;
  outcome.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  for (const timeval& time : {used.ru_utime, used.ru_stime}) {
    outcome.cpu_seconds += static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  }
  outcome.by_signal = WIFSIGNALED(status);
  outcome.exit_code = outcome.by_signal ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
  if (!options.out_file) {
    outcome.out = read_bytes(out);
  }
  outcome.err = read_bytes(err);
  return outcome;
}

Outcome run_program(const std::vector<std::string>& arguments, const RunOptions& options) {
  std::vector<std::string> command{RIDGECRAFT_PROGRAM};
  command.insert(command.end(), arguments.begin(), arguments.end());
  return run_command(command, options);
}

bool can_drop_rights() {
  if (::geteuid() != 0) {
    return false;
  }
  RunOptions options;
  options.as_nobody = true;
  options.folder = "/";
  return run_program({"--version"}, options).exit_code == 0;
}

}  // namespace ridgecraft::test
