// SPDX-License-Identifier: GPL-3.0-or-later
// SIGINT, SIGTERM and SIGHUP where no job runs that would look for them.
#include <csignal>

#include <catch2/catch.hpp>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "cli/program_checks.hpp"
#include "support/temporary_folder.hpp"

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
  options.interrupt_after_s = 2.0;
  const Outcome outcome = run_program({"house.obj", "-o", "house.pdf"}, options);
  CHECK(outcome.exit_code == 130);
  CHECK(outcome.err.find("interrupted after the files were written") != std::string::npos);
  CHECK(folder.names() == std::set<std::string>{"house.obj", "house.pdf", "pipe"});
}

TEST_CASE("signals that are ignored stay ignored", "[signals]") {
  const TemporaryFolder folder;
  write_bytes(folder / "house.obj", house);
  RunOptions options = in(folder);
  options.interrupt_after_s = GENERATE(0.01, 0.05, 0.1);
  options.signal = SIGHUP;
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
