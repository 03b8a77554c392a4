// SPDX-License-Identifier: GPL-3.0-or-later
// What comments promise, and what libraries say, as far as a search for words can hold it.
#include <filesystem>
#include <fstream>
#include <functional>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

namespace {

namespace fs = std::filesystem;

/// The folders of the program's own code.
std::vector<fs::path> rooms() {
  std::vector<fs::path> found;
  for (const auto& entry : fs::directory_iterator(RIDGECRAFT_SOURCE_DIR)) {
    const std::string name = entry.path().filename().string();
    static const std::set<std::string> others{"build", "tests", "bench", "samples", "docs", "cmake"};
    if (entry.is_directory() && !name.starts_with(".") && !others.contains(name)) {
      found.push_back(entry.path());
    }
  }
  return found;
}

/// Visits each line of the sources below a folder.
void for_each_line(const fs::path& folder,
                   const std::function<void(const std::string& place, const std::string& line)>& visit) {
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string suffix = entry.path().extension().string();
    if (suffix != ".hpp" && suffix != ".cpp") {
      continue;
    }
    std::ifstream in(entry.path());
    std::size_t number = 0;
    for (std::string line; std::getline(in, line);) {
      visit(entry.path().string() + ":" + std::to_string(++number), line);
    }
  }
}

/// The words of `enum class ErrorKind`, from the header that has it.
std::set<std::string> error_kinds() {
  std::set<std::string> kinds;
  for (const fs::path& room : rooms()) {
    bool inside = false;
    for_each_line(room, [&](const std::string& /*place*/, const std::string& line) {
      std::smatch match;
      if (line.starts_with("enum class ErrorKind")) {
        inside = true;
      } else if (inside && line.starts_with("}")) {
        inside = false;
      } else if (inside && std::regex_search(line, match, std::regex(R"(^\s+(\w+),)"))) {
        kinds.insert(match[1].str());
      }
    });
  }
  return kinds;
}

}  // namespace

TEST_CASE("errors that comments announce are of a kind that there is", "[comments]") {
  const std::set<std::string> kinds = error_kinds();
  REQUIRE(kinds.contains("unreadable_input"));
  const std::regex announced(R"(//.*\bError\((\w+)\))");
  std::size_t seen = 0;
  for (const fs::path& room : rooms()) {
    for_each_line(room, [&](const std::string& place, const std::string& line) {
      std::smatch match;
      for (std::string rest = line; std::regex_search(rest, match, announced);
           rest = "//" + match.suffix().str()) {
        INFO(place << ": " << line);
        CHECK(kinds.contains(match[1].str()));
        ++seen;
      }
    });
  }
  CHECK(seen > 10);
}

TEST_CASE("libraries don't speak of the program's options", "[comments]") {
  const std::regex option_in_text(R"re("[^"]*--[a-z][^"]*")re");
  const std::regex tables("base/(?:option|message)_table");
  for (const fs::path& room : rooms()) {
    if (room.filename() == "cli") {
      continue;
    }
    for_each_line(room, [&](const std::string& place, const std::string& line) {
      if (line.find_first_not_of(' ') != std::string::npos && !std::regex_search(place, tables) &&
          line.compare(line.find_first_not_of(' '), 2, "//") != 0) {
        INFO(place);
        CHECK_FALSE(std::regex_search(line, option_in_text));
      }
    });
  }
}
