// SPDX-License-Identifier: GPL-3.0-or-later
// docs/reference/json.md names each key that --json prints, and none besides.
#include <algorithm>
#include <array>
#include <set>
#include <sstream>

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/program_checks.hpp"
#include "support/temporary_folder.hpp"

using namespace ridgecraft::test;
using Json = nlohmann::json;

namespace {

/// All keys under their paths: "index[].joins[].piece".
void collect(const Json& json, const std::string& path, std::set<std::string>& keys) {
  if (json.is_object()) {
    for (const auto& [key, value] : json.items()) {
      const std::string here = path + (path.empty() ? "" : ".") + key;
      keys.insert(here);
      collect(value, here, keys);
    }
  } else if (json.is_array()) {
    for (const Json& item : json) {
      collect(item, path + "[]", keys);
    }
  }
}

/// What stands between backticks in the tables of a section, but for links and options.
std::set<std::string> documented(const std::string& section) {
  std::istringstream lines(read_bytes(std::string(RIDGECRAFT_SOURCE_DIR) + "/docs/reference/json.md"));
  std::set<std::string> keys;
  std::string inside = "all";
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("## ")) {
      inside = line.substr(4, line.rfind('`') - 4);
    }
    if (!line.starts_with("|") || (inside != section && inside != "all")) {
      continue;
    }
    for (std::size_t at = line.find('`'); at != std::string::npos; at = line.find('`', at + 1)) {
      const std::size_t end = line.find('`', at + 1);
      const std::string word = line.substr(at + 1, end - at - 1);
      if (word.find_first_of("-/ ") == std::string::npos && word != "null") {
        keys.insert(word);
      }
      at = end;
    }
  }
  return keys;
}

bool matches(const std::string& pattern, const std::string& key) {
  const bool open = pattern.ends_with(".*");
  return pattern == key || (open && key.starts_with(pattern.substr(0, pattern.size() - 1)));
}

}  // namespace

TEST_CASE("the keys of --json are documented, each of them and no other", "[json][slow]") {
  const TemporaryFolder folder;
  write_bytes(folder / "house.obj", house);
  write_bytes(folder / "house.seg", "0\n0\n0\n0\n0\n1\n1\n");
  // A bar with closed ends, and a triangle beside it.
  write_bytes(folder / "bar.obj",
              "v 0 0 0\nv 100 0 0\nv 100 0.5 0\nv 0 0.5 0\nv 0 0 20\nv 100 0 20\nv 100 0.5 20\nv 0 0.5 20\n"
              "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n"
              "v 20 5 0\nv 60 5 0\nv 40 5 15\nf 9 10 11\n");
  // A box on a box.
  std::string boxes;
  for (const auto& [low, high, size] : {std::array{0, 20, 60}, std::array{20, 30, 30}}) {
    for (const int z : {low, high}) {
      boxes += fmt::format("v 0 0 {1}\nv {0} 0 {1}\nv {0} {0} {1}\nv 0 {0} {1}\n", size, z);
    }
    boxes += "f -5 -6 -7 -8\nf -4 -3 -2 -1\nf -8 -7 -3 -4\nf -7 -6 -2 -3\nf -6 -5 -1 -2\nf -5 -8 -4 -1\n";
  }
  write_bytes(folder / "boxes.obj", boxes);
  REQUIRE(run_program({"house.obj", "-o", "bad.fold"}, in(folder)).exit_code == 0);
  Json fold = Json::parse(read_bytes(folder / "bad.fold"));
  fold["vertices_coords"][0][0] = 1e3;
  write_bytes(folder / "bad.fold", fold.dump());
  REQUIRE(run_program({"house.obj", "-o", "."}, in(folder)).exit_code == 0);
  const std::string flat = "x.fold";
  const std::vector<std::pair<std::string, std::vector<std::vector<std::string>>>> verbs{
      {"ridgecraft MODEL",
       {{"bar.obj", "--size", "100mm", "--faces", "keep", "-o", flat},
        {"bar.obj", "--size", "100mm", "--faces", "keep", "--max-faces", "1", "-o", flat, "--overwrite"},
        {"house.obj", "--size", "1mm", "-o", "y.fold"},
        {"house.obj", "--size", "30cm", "-o", "y.fold"},
        {"house.obj", "--size", "8cm", "-o", "z.pdf"},
        {"house.obj", "--tabs", "slots", "-o", "s.fold"},
        {"boxes.obj", "--keep-bodies", "-o", "y.fold", "--overwrite"}}},
      {"ridgecraft segment",
       {{"segment", "bar.obj"}, {"segment", "house.obj", "--parts", "1", "--compare", "house.seg"}}},
      {"ridgecraft unfold", {{"unfold", "bar.obj", "--tabs"}}},
      {"ridgecraft info", {{"info", "bar.obj"}}},
      {"ridgecraft hulls", {{"hulls", "bar.obj", "-o", "x.obj"}, {"shell", "bar.obj", "-o", "y.obj"}}},
      {"ridgecraft verify",
       {{"verify", "bad.fold"}, {"verify", "house.fold", "--model", "house.obj", "--pages", "house.pdf"}}},
      {"ridgecraft batch", {{"batch", "hulls", "house.obj", "-o", "batch"}}},
      {"ridgecraft formats", {{"formats"}}}};
  for (const auto& [verb, runs] : verbs) {
    std::set<std::string> keys;
    for (std::vector<std::string> arguments : runs) {
      arguments.push_back("--json");
      const Outcome outcome = run_program(arguments, in(folder));
      INFO(outcome.err);
      REQUIRE((outcome.exit_code == 0 || outcome.exit_code == 6));
      collect(Json::parse(outcome.out), "", keys);
    }
    const std::set<std::string> told = documented(verb);
    for (const std::string& key : keys) {
      INFO(verb << " prints " << key);
      CHECK(std::any_of(told.begin(), told.end(), [&](const std::string& t) { return matches(t, key); }));
    }
    for (const std::string& key : told) {
      // Common to most verbs; or there only where a file has hundreds of faults.
      if (key == "model" || key.starts_with("repairs") || key.starts_with("seconds") || key == "files" ||
          key.starts_with("faults_not_listed")) {
        continue;
      }
      INFO(verb << " is said to print " << key);
      CHECK(std::any_of(keys.begin(), keys.end(), [&](const std::string& k) { return matches(key, k); }));
    }
  }
}

TEST_CASE("seconds have one form everywhere", "[json]") {
  const TemporaryFolder folder;
  write_bytes(folder / "house.obj", house);
  const std::vector<std::vector<std::string>> jobs{{"house.obj", "-o", "x.fold"},
                                                   {"segment", "house.obj"},
                                                   {"unfold", "house.obj"},
                                                   {"hulls", "house.obj", "-o", "x.obj"}};
  for (std::vector<std::string> arguments : jobs) {
    arguments.push_back("--json");
    const Outcome outcome = run_program(arguments, in(folder));
    INFO(arguments.front() << ": " << outcome.err);
    REQUIRE(outcome.exit_code == 0);
    const Json seconds = Json::parse(outcome.out).at("seconds");
    REQUIRE(seconds.is_object());
    double sum = 0.0;
    for (const auto& [stage, value] : seconds.items()) {
      sum += stage == "total" ? 0.0 : value.get<double>();
    }
    CHECK(seconds.at("total").get<double>() == Approx(sum).margin(1e-5));
  }
}
