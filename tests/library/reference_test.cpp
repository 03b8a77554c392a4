// SPDX-License-Identifier: GPL-3.0-or-later
// What the public headers say of themselves.
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "support/program.hpp"
#include "support/temporary_folder.hpp"

using namespace ridgecraft;
namespace fs = std::filesystem;

namespace {

/// What Doxygen has to say, with more settings than those of the project.
std::vector<std::string> warnings_of_doxygen(const test::TemporaryFolder& folder, const std::string& more) {
  std::ifstream settings(fs::path(RIDGECRAFT_BINARY_DIR) / "Doxyfile");
  REQUIRE(settings);
  const fs::path file = folder / "Doxyfile";
  std::ofstream(file) << settings.rdbuf() << "OUTPUT_DIRECTORY = " << (folder / "reference").string() << '\n'
                      << more;
  const test::Outcome outcome = test::run_command({"doxygen", file.string()});
  CHECK(outcome.exit_code == 0);
  CHECK(fs::exists(folder / "reference/html/index.html"));
  std::vector<std::string> lines;
  std::istringstream told(outcome.err);
  for (std::string line; std::getline(told, line);) {
    lines.push_back(line);
  }
  return lines;
}

}  // namespace

TEST_CASE("the reference is made without a warning", "[library]") {
  const test::TemporaryFolder folder;
  for (const std::string& warning : warnings_of_doxygen(folder, "")) {
    FAIL_CHECK(warning);
  }
}

TEST_CASE("each public type and free function says what it is for", "[library]") {
  const test::TemporaryFolder folder;
  const std::regex type_or_function("warning: (Compound |.* of (file|namespace) |.*\\(enumeration\\))");
  for (const std::string& warning : warnings_of_doxygen(folder, "EXTRACT_ALL = NO\n")) {
    if (std::regex_search(warning, type_or_function)) {
      FAIL_CHECK(warning);
    }
  }
}
