// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/program_checks.hpp"

#include <algorithm>

#include <catch2/catch.hpp>

namespace ridgecraft::test {

const char* const house = R"(# a house
v 0 0 0
v 4 0 0
v 4 5 0
v 0 5 0
v 0 0 4
v 4 0 4
v 4 5 4
v 0 5 4
v 2 0 6
v 2 5 6
f 4 3 2 1
f 1 2 6 9 5
f 3 4 8 10 7
f 2 3 7 6
f 4 1 5 8
f 6 7 10 9
f 8 5 9 10
)";

RunOptions in(const TemporaryFolder& folder) {
  RunOptions options;
  options.folder = folder.path();
  return options;
}

void check_refusal(const Outcome& outcome, int code, const std::string& word) {
  CAPTURE(outcome.err);
  CHECK(outcome.exit_code == code);
  CHECK_FALSE(outcome.by_signal);
  CHECK(outcome.out.empty());
  CHECK(outcome.err.starts_with("ridgecraft: "));
  CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
  CHECK(outcome.err.find(word) != std::string::npos);
}

}  // namespace ridgecraft::test
