// SPDX-License-Identifier: GPL-3.0-or-later
// SIGINT, SIGTERM and SIGHUP while a job runs.
#include <chrono>
#include <csignal>

#include <catch2/catch.hpp>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

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

}  // namespace

TEST_CASE("a job that waits for its model ends at a signal", "[signals]") {
  const TemporaryFolder folder;
  RunOptions options = in(folder);
  options.interrupt_after_s = 0.2;
  options.when_heeded = true;
  options.signal = GENERATE(SIGINT, SIGTERM, SIGHUP);
  const std::string program = RIDGECRAFT_PROGRAM;
  const Outcome outcome =
      run_command({"/bin/sh", "-c", "mkfifo pipe; exec " + program + " info - --json <> pipe"}, options);
  CHECK(outcome.exit_code == 130);
  CHECK_FALSE(outcome.by_signal);
  CHECK(outcome.err == "ridgecraft: stopped before the work was done; nothing was written\n");
  CHECK(outcome.out.find("\"code\": 130") != std::string::npos);
}

TEST_CASE("a job that looks at no signal ends a second later", "[signals]") {
  const TemporaryFolder folder;
  const FullPipe pipe(folder / "pipe");
  write_bytes(folder / "house.obj", house);
  RunOptions options = in(folder);
  options.out_file = folder / "pipe";
  options.interrupt_after_s = 0.5;
  options.when_heeded = true;
  const Outcome outcome = run_program({"info", "house.obj"}, options);
  CHECK(outcome.exit_code == 130);
  CHECK(outcome.err == "\nridgecraft: interrupted before the work was done\n");
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
