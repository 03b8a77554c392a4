// SPDX-License-Identifier: GPL-3.0-or-later
// ridgecraft batch from outside: a line a model, whatever happens to it or to the batch.
#include <cstdlib>
#include <filesystem>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "cli/program_checks.hpp"
#include "support/temporary_folder.hpp"

namespace ridgecraft {
namespace {

using Line = nlohmann::ordered_json;
using namespace test;

/// A box of this height.
std::string box(int height) {
  const std::string h = std::to_string(height);
  std::string text;
  for (const std::string& z : {std::string("0"), h}) {
    text += "v 0 0 " + z + "\nv 1 0 " + z + "\nv 1 1 " + z + "\nv 0 1 " + z + "\n";
  }
  return text + "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
}

/// A folder of boxes, with models that can't be read among them.
void write_models(const TemporaryFolder& folder) {
  std::filesystem::create_directories(folder / "models/deeper");
  for (int i = 1; i <= 8; ++i) {
    write_bytes(folder / ("models/" + std::to_string(i) + ".obj"), box(i));
  }
  write_bytes(folder / "models/deeper/garbage.obj", "this is no model\n");
  write_bytes(folder / "models/deeper/empty.stl", "");
  write_bytes(folder / "models/readme.txt", "no model");
}

/// Its lines without what differs from run to run.
std::vector<Line> lines_of(const std::string& text) {
  std::vector<Line> lines;
  std::istringstream file(text);
  for (std::string line; std::getline(file, line);) {
    lines.push_back(Line::parse(line));
    lines.back().erase("seconds");
    lines.back().erase("peak_bytes");
  }
  return lines;
}

std::vector<std::string> hulls_into(const std::string& output) {
  return {"batch", "hulls", "models", "-o", output};
}

}  // namespace

TEST_CASE("A batch has a line for each model, in order, whatever happens to it", "[batch]") {
  const TemporaryFolder folder;
  write_models(folder);
  const Outcome outcome =
      run_program({"batch", "hulls", "models", "-o", "out", "--jobs", "3", "--json"}, in(folder));
  INFO(outcome.err);
  REQUIRE(outcome.exit_code == 0);
  const Line told = Line::parse(outcome.out);
  CHECK(told["models"] == 10);
  CHECK(told["codes"] == Line::parse(R"([{"exit_code": 0, "models": 8}, {"exit_code": 3, "models": 2}])"));
  const std::vector<Line> lines = lines_of(read_bytes(folder / "out/report.jsonl"));
  REQUIRE(lines.size() == 10);
  std::string before;
  for (const Line& line : lines) {
    const std::string model = line["model"];
    CHECK(before < model);
    before = model;
    const bool is_box = model.find("deeper") == std::string::npos;
    CHECK(line["exit_code"] == (is_box ? 0 : 3));
    CHECK(line["sentence"].get<std::string>().empty() == is_box);
    CHECK(line["outputs"].size() == (is_box ? 1 : 0));
    if (is_box) {
      CHECK(std::filesystem::exists(folder / "out" / line["outputs"][0]["file"].get<std::string>()));
      CHECK(line["figures"]["bodies"].size() == 1);
    }
  }
}

TEST_CASE("The report is the same for any number of jobs and shards", "[batch]") {
  const TemporaryFolder folder;
  write_models(folder);
  const auto report = [&](const std::vector<std::string>& options, const std::string& name) {
    std::vector<std::string> words = hulls_into("out" + std::to_string(options.size()) + name);
    const std::string output = words.back();
    words.insert(words.end(), options.begin(), options.end());
    const Outcome outcome = run_program(words, in(folder));
    INFO(outcome.err);
    REQUIRE(outcome.exit_code == 0);
    return lines_of(read_bytes(folder / output / name));
  };
  const std::vector<Line> one = report({"--jobs", "1"}, "report.jsonl");
  CHECK(report({"--jobs", "8", "-q"}, "report.jsonl") == one);
  std::map<std::string, Line> from_shards;
  for (const std::string shard : {"1", "2", "3"}) {
    for (const Line& line : report({"--shard", shard + "/3"}, "report-" + shard + "-of-3.jsonl")) {
      CHECK(from_shards.emplace(line["model"], line).second);
    }
  }
  REQUIRE(from_shards.size() == one.size());
  for (const Line& line : one) {
    CHECK(from_shards.at(line["model"]) == line);
  }
}

TEST_CASE("A batch that was killed goes on, and has the report of an undisturbed one", "[batch]") {
  const TemporaryFolder folder;
  write_models(folder);
  REQUIRE(run_program(hulls_into("whole"), in(folder)).exit_code == 0);
  const std::vector<Line> whole = lines_of(read_bytes(folder / "whole/report.jsonl"));
  for (int moment = 0; moment < 5; ++moment) {
    const std::string output = "out" + std::to_string(moment);
    const std::string command = "cd '" + folder.path().string() + "' && timeout -s KILL " +
                                std::to_string(0.02 + 0.05 * moment) + " '" + RIDGECRAFT_PROGRAM +
                                "' batch hulls models -q --jobs 2 -o " + output + " 2> /dev/null";
    static_cast<void>(std::system(command.c_str()));
    std::vector<std::string> words = hulls_into(output);
    words.insert(words.end(), {"--resume", "--json"});
    const Outcome outcome = run_program(words, in(folder));
    INFO(outcome.err);
    REQUIRE(outcome.exit_code == 0);
    CHECK(lines_of(read_bytes(folder / output / "report.jsonl")) == whole);
  }
}

TEST_CASE("What an earlier run did isn't done again, but for what has changed", "[batch]") {
  const TemporaryFolder folder;
  write_models(folder);
  REQUIRE(run_program(hulls_into("out"), in(folder)).exit_code == 0);
  const auto resumed = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words = hulls_into("out");
    words.insert(words.end(), {"--resume", "--json"});
    words.insert(words.end(), more.begin(), more.end());
    return Line::parse(run_program(words, in(folder)).out)["done_before"].get<int>();
  };
  CHECK(resumed({}) == 10);
  write_bytes(folder / "models/3.obj", box(33));
  CHECK(resumed({}) == 9);
  std::filesystem::remove(folder / "out/5.obj.obj");
  CHECK(resumed({}) == 9);
  // A line that was cut off is none.
  const std::string report = read_bytes(folder / "out/report.jsonl");
  write_bytes(folder / "out/report.jsonl", report.substr(0, report.size() - 20));
  CHECK(resumed({}) == 9);
  // Nor is one with values of other types.
  write_bytes(folder / "out/report.jsonl", report + "{\"model\":\"models/1.obj\",\"options\":5}\n");
  CHECK(resumed({}) == 10);
  // What --time-limit ended is tried again.
  std::string stopped = report;
  const std::string code = "\"exit_code\":0";
  stopped.replace(stopped.find(code), code.size(), "\"exit_code\":130");
  write_bytes(folder / "out/report.jsonl", stopped);
  CHECK(resumed({}) == 9);
  CHECK(resumed({"--", "--max-vertices", "8"}) == 0);
  // Without --resume an earlier report is no one's to replace.
  check_refusal(run_program(hulls_into("out"), in(folder)), 7, "--resume");
}

TEST_CASE("A process that fails in whatever way leaves a line", "[batch]") {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder / "models");
  write_bytes(folder / "models/1.obj", box(1));
  std::vector<std::string> words = hulls_into("out");
  words.insert(words.end(), {"--memory-limit", "1"});  // not even the program fits
  REQUIRE(run_program(words, in(folder)).exit_code == 0);
  const std::vector<Line> lines = lines_of(read_bytes(folder / "out/report.jsonl"));
  REQUIRE(lines.size() == 1);
  // A report may lie where the program was called.
  std::vector<std::string> here = hulls_into("out2");
  here.insert(here.end(), {"--report", "here.jsonl"});
  CHECK(run_program(here, in(folder)).exit_code == 0);
  CHECK(lines_of(read_bytes(folder / "here.jsonl")).size() == 1);
  CHECK(lines[0]["exit_code"] != 0);
  CHECK(lines[0]["outputs"].empty());
}

TEST_CASE("Lists, single models and each verb are done, and what can't be is said before", "[batch]") {
  const TemporaryFolder folder;
  write_models(folder);
  write_bytes(folder / "list.txt", "models/2.obj\r\n\nmodels/1.obj\nmissing.obj\n");
  const std::map<std::string, std::string> suffixes{
      {"hulls", ".obj"}, {"segment", ".seg"}, {"unfold", ".fold"}, {"paper", ".pdf"}};
  for (const auto& [verb, suffix] : suffixes) {
    const Outcome outcome = run_program({"batch", verb, "list.txt", "-o", verb}, in(folder));
    INFO(outcome.err);
    REQUIRE(outcome.exit_code == 0);
    const std::vector<Line> lines = lines_of(read_bytes(folder / verb / "report.jsonl"));
    REQUIRE(lines.size() == 3);
    CHECK(lines[0]["model"] == "models/2.obj");
    CHECK(lines[2]["exit_code"] == 3);
    CHECK(std::filesystem::exists(folder / verb / ("models/2.obj" + suffix)));
  }
  REQUIRE(run_program({"batch", "info", "models/1.obj", "-o", "told"}, in(folder)).exit_code == 0);
  CHECK(lines_of(read_bytes(folder / "told/report.jsonl")).at(0)["figures"]["faces"] == 12);
  for (const auto& [words, said] : std::vector<std::pair<std::vector<std::string>, std::string>>{
           {{"batch"}, "what to do"},
           {{"batch", "verify", "models", "-o", "x"}, "verify"},
           {{"batch", "hulls", "models"}, "-o"},
           {{"batch", "hulls", "models", "-o", "x", "--shard", "4/3"}, "--shard"},
           {{"batch", "hulls", "models", "-o", "x", "--", "--no-such-option"}, "--no-such-option"},
           {{"batch", "hulls", "models", "-o", "x", "--", "-o", "y.obj"}, "behind --"},
           {{"batch", "hulls", "models", "-o", "x", "--", "-oy.obj"}, "behind --"}}) {
    check_refusal(run_program(words, in(folder)), 2, said);
  }
  CHECK_FALSE(std::filesystem::exists(folder / "x"));
  check_refusal(run_program({"batch", "hulls", "no-such-list", "-o", "x"}, in(folder)), 3, "no-such-list");
}

}  // namespace ridgecraft
