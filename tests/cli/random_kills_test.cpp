// SPDX-License-Identifier: GPL-3.0-or-later
// The program killed at random moments, and what the next run makes of it.
#include <chrono>
#include <cstddef>
#include <functional>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "cli/killed_runs_checks.hpp"
#include "cli/program_checks.hpp"
#include "support/temporary_folder.hpp"

using namespace ridgecraft;
using namespace ridgecraft::test;

namespace {

/// Kills the program at random moments, half of them while files are being written, and lets another run into
/// the folder follow.
class Killings {
 public:
  Killings() {
    write_bytes(folder_ / "house.obj", house);
    REQUIRE(run_program(small_, in(folder_)).exit_code == 0);
    before_ = results();
    const Outcome outcome = run_program(large_, in(folder_));
    REQUIRE(outcome.exit_code == 0);
    seconds_ = outcome.seconds;
    after_ = results();
    REQUIRE(after_.size() > before_.size());
  }

  void kill_one() {
    REQUIRE(run_program(small_, in(folder_)).exit_code == 0);
    REQUIRE(results() == before_);
    RunOptions options = in(folder_);
    options.kill_when = moment();
    const Outcome killed = run_program(large_, options);
    const std::size_t hidden = hidden_in(folder_.path());
    const bool to_be_told = is_to_be_told(folder_.path());
    const Contents found = results();
    left_something_ += hidden > 0 ? 1U : 0U;
    mixed_ += found != before_ && found != after_ ? 1U : 0U;
    hidden_ += hidden;
    killed_ += killed.by_signal ? 1U : 0U;
    const Outcome next = run_program({"segment", "house.obj", "--labels", "labels.next"}, in(folder_));
    INFO(next.err);
    CHECK(next.exit_code == 0);
    CHECK((next.err.find("killed") != std::string::npos) == to_be_told);
    CHECK(hidden_in(folder_.path()) == 0);
    const Contents now = results();
    CHECK((now == before_ || now == after_));
  }

  /// A run may have come to its end before.
  [[nodiscard]] std::size_t killed() const { return killed_; }
  [[nodiscard]] std::string figures() const {
    return std::to_string(killed_) + " killed, of which " + std::to_string(left_something_) + " left " +
           std::to_string(hidden_) + " hidden files and " + std::to_string(mixed_) +
           " a mixed set, until the next run";
  }

 private:
  [[nodiscard]] Contents results() const {
    Contents all = visible(folder_.path());
    all.erase("house.obj");
    return all;
  }

  /// In turn: any moment of the run; soon after its first hidden file.
  std::function<bool()> moment() {
    using Clock = std::chrono::steady_clock;
    while_writing_ = !while_writing_;
    const double wait_s =
        std::uniform_real_distribution<double>(0.0, while_writing_ ? 0.05 : seconds_)(random_);
    const auto wait = std::chrono::duration<double>(wait_s);
    return
        [this, wait, start = while_writing_ ? std::optional<Clock::time_point>() : Clock::now()]() mutable {
          if (!start && hidden_in(folder_.path()) > 0) {
            start = Clock::now();
          }
          return start && Clock::now() - *start >= wait;
        };
  }

  const std::vector<std::string> small_{"house.obj", "--size", "8cm"};
  const std::vector<std::string> large_{"house.obj", "--size", "25cm"};
  TemporaryFolder folder_;
  Contents before_;
  Contents after_;
  double seconds_ = 0.0;
  bool while_writing_ = false;
  std::mt19937 random_{std::random_device{}()};
  std::size_t killed_ = 0;
  std::size_t left_something_ = 0;
  std::size_t mixed_ = 0;
  std::size_t hidden_ = 0;
};

}  // namespace

TEST_CASE("the program killed at 80 random moments", "[killed][slow]") {
  Killings killings;
  while (killings.killed() < 80) {
    killings.kill_one();
  }
  WARN(killings.figures());
}

TEST_CASE("a program that is killed before it has begun has said nothing", "[killed]") {
  RunOptions options;
  options.kill_when = [] { return true; };
  for (int i = 0; i < 20; ++i) {
    const Outcome outcome = run_program({"--version"}, options);
    CHECK((outcome.by_signal || outcome.exit_code == 0));
    CHECK(outcome.err.empty());
  }
}
