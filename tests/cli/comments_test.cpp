// SPDX-License-Identifier: GPL-3.0-or-later
// What comments promise, and what libraries say, as far as a search for words can hold it.
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
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

/// A file's text with the lines of each comment joined.
std::string joined_comments(const fs::path& file) {
  std::ifstream in(file);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  return std::regex_replace(text, std::regex(R"(\n[ \t]*//+<?[ \t]*)"), " ");
}

/// Whether a page of docs/ has a heading that begins so.
bool has_heading(const std::string& page, const std::string& beginning) {
  std::ifstream in(fs::path(RIDGECRAFT_SOURCE_DIR) / "docs" / page);
  std::string line;
  while (std::getline(in, line)) {
    const std::size_t text = line.find_first_not_of('#');
    if (text > 0 && text != std::string::npos &&
        line.compare(text, 1 + beginning.size(), " " + beginning) == 0) {
      return true;
    }
  }
  return false;
}

}  // namespace

TEST_CASE("headings of docs that comments name are there", "[comments]") {
  const std::regex named(R"re(docs/([a-z-]+\.md), "([^"]+)")re");
  std::size_t seen = 0;
  for (const fs::path& room : rooms()) {
    for (const auto& entry : fs::recursive_directory_iterator(room)) {
      const std::string suffix = entry.path().extension().string();
      if (suffix != ".hpp" && suffix != ".cpp") {
        continue;
      }
      const std::string text = joined_comments(entry.path());
      for (auto at = std::sregex_iterator(text.begin(), text.end(), named); at != std::sregex_iterator();
           ++at) {
        INFO(entry.path() << " names " << (*at)[0]);
        CHECK(has_heading((*at)[1], (*at)[2]));
        ++seen;
      }
    }
  }
  CHECK(seen > 20);
}

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
  for (const fs::path& room : rooms()) {
    if (room.filename() == "cli") {
      continue;
    }
    for_each_line(room, [&](const std::string& place, const std::string& line) {
      if (line.find_first_not_of(' ') != std::string::npos &&
          line.compare(line.find_first_not_of(' '), 2, "//") != 0) {
        INFO(place);
        CHECK_FALSE(std::regex_search(line, option_in_text));
      }
    });
  }
}
