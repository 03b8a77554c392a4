// SPDX-License-Identifier: GPL-3.0-or-later
// SIGINT, SIGTERM and SIGHUP where no job runs that would look for them.
#include <chrono>
#include <csignal>
#include <optional>
#include <stdexcept>
#include <thread>

#include <catch2/catch.hpp>
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "cli/early_end.hpp"
#include "cli/files/set/pending_files.hpp"
#include "cli/interruption.hpp"
#include "cli/program_checks.hpp"
#include "support/temporary_folder.hpp"

using namespace ridgecraft;
using namespace ridgecraft::test;

namespace {

/// A pipe that takes no more: who writes into it waits.
class FullPipe {
 public:
  explicit FullPipe(const std::filesystem::path& place) {
    REQUIRE(::mkfifo(place.c_str(), 0600) == 0);
    pipe_ = ::open(place.c_str(), O_RDWR | O_NONBLOCK);
    REQUIRE(pipe_ >= 0);
    while (::write(pipe_, "x", 1) == 1) {
    }
  }
  ~FullPipe() { ::close(pipe_); }
  FullPipe(const FullPipe&) = delete;
  FullPipe& operator=(const FullPipe&) = delete;

 private:
  int pipe_ = -1;
};

/// Does the work in a process of its own that heeds signals as the program does. Its exit code, 0 at its end.
int exit_code_of(void (*work)()) {
  const pid_t child = ::fork();
  if (child == 0) {
    const int nowhere = ::open("/dev/null", O_WRONLY);
    ::dup2(nowhere, STDERR_FILENO);
    cli::end_at_signals(false);
    work();
    ::_exit(0);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace

TEST_CASE("signals are heeded where no job runs", "[signals]") {
  const TemporaryFolder folder;
  const FullPipe pipe(folder / "pipe");
  RunOptions options = in(folder);
  options.out_file = folder / "pipe";
  options.interrupt_after_s = 0.5;
  options.signal = GENERATE(SIGINT, SIGTERM, SIGHUP);
  const Outcome outcome = run_program({"--help"}, options);
  CHECK_FALSE(outcome.by_signal);
  CHECK(outcome.exit_code == 130);
  CHECK(outcome.err == "\nridgecraft: interrupted; nothing was written\n");
}

TEST_CASE("a signal while the summary is printed says that the files are there", "[signals]") {
  const TemporaryFolder folder;
  write_bytes(folder / "house.obj", house);
  const FullPipe pipe(folder / "pipe");
  RunOptions options = in(folder);
  options.out_file = folder / "pipe";
  // However long the job takes: the summary is what is left to do once its last file is there, and the pipe
  // holds it up.
  const auto patience = std::chrono::steady_clock::now() + std::chrono::minutes(5);
  options.interrupt_from = [&] {
    return std::filesystem::exists(folder / "house-guide.pdf") || std::chrono::steady_clock::now() > patience;
  };
  options.interrupt_after_s = 1.0;
  const Outcome outcome = run_program({"house.obj", "-o", "house.pdf"}, options);
  CHECK(outcome.exit_code == 130);
  CHECK(outcome.err.find("interrupted after the files were written") != std::string::npos);
  CHECK(folder.names() == std::set<std::string>{"house.obj", "house.pdf", "house-guide.pdf", "pipe"});
}

TEST_CASE("signals that are ignored stay ignored", "[signals]") {
  const TemporaryFolder folder;
  write_bytes(folder / "house.obj", house);
  RunOptions options = in(folder);
  options.interrupt_after_s = GENERATE(0.01, 0.05, 0.1);
  options.signal = SIGHUP;
  options.when_heeded = true;
  const std::string program = RIDGECRAFT_PROGRAM;
  const Outcome outcome =
      run_command({"/bin/sh", "-c", "trap '' HUP; exec " + program + " house.obj -o house.pdf"}, options);
  CHECK(outcome.exit_code == 0);
}

TEST_CASE("no signal ends the program by itself once its code has begun", "[signals]") {
  // Before that, while the system loads libraries, nobody can keep a signal from ending it.
  const TemporaryFolder folder;
  write_bytes(folder / "house.obj", house);
  for (int i = 0; i < 40; ++i) {
    RunOptions options = in(folder);
    options.interrupt_after_s = 0.001 * i;
    options.when_heeded = true;
    const Outcome outcome = run_program({"info", "house.obj"}, options);
    CAPTURE(i, outcome.err);
    CHECK_FALSE(outcome.by_signal);
    CHECK((outcome.exit_code == 130 || outcome.exit_code == 0));
    CHECK((outcome.exit_code == 0) == outcome.err.empty());
  }
}

TEST_CASE("a signal between the summary and the end of a job isn't lost", "[signals]") {
  for (int i = 0; i < 20; ++i) {
    CHECK(exit_code_of([] {
            cli::PendingFiles pending;
            std::optional<cli::Interruption> interruption(pending);
            ::kill(::getpid(), SIGTERM);  // nobody looks at the stop token any more
            interruption.reset();
          }) == 130);
  }
}

TEST_CASE("a job that fails when a signal comes tells its failure", "[signals]") {
  CHECK(exit_code_of([] {
          cli::PendingFiles pending;
          try {
            const cli::Interruption interruption(pending);
            ::kill(::getpid(), SIGTERM);
            while (!interruption.stopped().stop_requested()) {
              std::this_thread::yield();
            }
            throw std::runtime_error("a failure");
          } catch (const std::runtime_error&) {
            ::_exit(7);
          }
        }) == 7);
}

TEST_CASE("a job's end waits for nothing", "[signals]") {
  constexpr int jobs = 50;
  const auto start = std::chrono::steady_clock::now();
  for (int i = 0; i < jobs; ++i) {
    cli::PendingFiles pending;
    const cli::Interruption interruption(pending);
  }
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  CHECK(seconds.count() < 0.01 * jobs);
}
