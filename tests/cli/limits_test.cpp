// SPDX-License-Identifier: GPL-3.0-or-later
// The finished program at its limits: time, threads, the size of a sheet; and how failures are told to
// machines.
#include <algorithm>
#include <cstdlib>
#include <string>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "program_checks.hpp"
#include "support/program.hpp"
#include "support/temporary_folder.hpp"

using namespace ridgecraft::test;
namespace fs = std::filesystem;
using Json = nlohmann::json;

namespace {

/// A cube of unit edges.
constexpr const char* cube_off = R"(OFF
8 6 0
0 0 0
1 0 0
1 1 0
0 1 0
0 0 1
1 0 1
1 1 1
0 1 1
4 3 2 1 0
4 0 1 5 4
4 1 2 6 5
4 2 3 7 6
4 3 0 4 7
4 4 5 6 7
)";

/// A wavy sheet of 2 n n faces: many parts, many overlaps.
std::string wavy_sheet(int n) {
  std::string off = "OFF\n" + std::to_string((n + 1) * (n + 1)) + " " + std::to_string(2 * n * n) + " 0\n";
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j <= n; ++j) {
      off += std::to_string(2 * i) + " " + std::to_string(2 * j) + " " +
             std::to_string((i * i + 3 * j * i) % 7) + "\n";
    }
  }
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const int a = (n + 1) * i + j;
      off +=
          "3 " + std::to_string(a) + " " + std::to_string(a + n + 1) + " " + std::to_string(a + n + 2) + "\n";
      off += "3 " + std::to_string(a) + " " + std::to_string(a + n + 2) + " " + std::to_string(a + 1) + "\n";
    }
  }
  return off;
}

/// Programs started meanwhile don't look for leaks. Nothing changes in builds without sanitizers.
class WithoutLeakSearch {
 public:
  WithoutLeakSearch() {
    const char* before = std::getenv("ASAN_OPTIONS");
    before_ = before == nullptr ? "" : before;
    ::setenv("ASAN_OPTIONS", (before_ + (before_.empty() ? "" : ":") + "detect_leaks=0").c_str(), 1);
  }
  ~WithoutLeakSearch() { ::setenv("ASAN_OPTIONS", before_.c_str(), 1); }
  WithoutLeakSearch(const WithoutLeakSearch&) = delete;
  WithoutLeakSearch& operator=(const WithoutLeakSearch&) = delete;

 private:
  std::string before_;
};

}  // namespace

TEST_CASE("a time limit that is too short to read stops with a sentence", "[limits]") {
  const TemporaryFolder folder;
  write_bytes(folder / "sheet.off", wavy_sheet(250));
  for (const char* verb : {"", "info", "segment", "unfold"}) {
    CAPTURE(verb);
    std::vector<std::string> arguments{"sheet.off", "--time-limit", "0.001"};
    if (*verb != '\0') {
      arguments.insert(arguments.begin(), verb);
    }
    const Outcome outcome = run_program(arguments, in(folder));
    CHECK(outcome.exit_code == 130);
    CHECK(outcome.err.find("--time-limit passed while sheet.off was") != std::string::npos);
    CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
    CHECK(folder.names() == std::set<std::string>{"sheet.off"});
  }
}

TEST_CASE("segmentation has no half result, and the main job says what it did without one", "[limits]") {
  const TemporaryFolder folder;
  write_bytes(folder / "sheet.off", wavy_sheet(120));
  // Long enough to read, far too short to segment 28,800 wavy faces to this tolerance.
  const Outcome parts = run_program(
      {"segment", "sheet.off", "--concavity", "0.005", "--time-limit", "1", "-o", "p.ply"}, in(folder));
  CHECK(parts.exit_code == 130);
  CHECK(parts.err.find("segmented") != std::string::npos);
  CHECK_FALSE(fs::exists(folder / "p.ply"));

  const Outcome nets = run_program(
      {"unfold", "sheet.off", "--concavity", "0.005", "--time-limit", "1", "-o", "n.fold", "--json"},
      in(folder));
  INFO(nets.err);
  REQUIRE(nets.exit_code == 0);
  const Json json = Json::parse(nets.out);
  CHECK(json["parts"] == 1);
  CHECK(json["notes"].dump().find("--time-limit") != std::string::npos);
  CHECK(run_program({"verify", "n.fold"}, in(folder)).exit_code == 0);
}

TEST_CASE("a time limit holds for a model far too large for it", "[limits][slow]") {
  const TemporaryFolder folder;
  // 80,000 faces that overlap a million times in the trees of their first nets.
  write_bytes(folder / "sheet.off", wavy_sheet(200));
  // What comes before the nets has no end that could be given up, and needs 1 s; sanitizers make 5 to 20 of
  // it, and one job is all that they have time for.
#ifdef RIDGECRAFT_SANITIZED
  const std::string limit = "20";
  const std::vector<std::vector<std::string>> jobs{{"unfold", "sheet.off", "--all-tabs"}};
#else
  const std::string limit = "4";
  const std::vector<std::vector<std::string>> jobs{
      {"sheet.off"}, {"unfold", "sheet.off"}, {"unfold", "sheet.off", "--all-tabs"}};
#endif
  for (const std::vector<std::string>& job : jobs) {
    CAPTURE(job);
    std::vector<std::string> arguments = job;
    arguments.insert(arguments.end(),
                     {"--faces", "keep", "--time-limit", limit, "-o", "n.fold", "--overwrite"});
    const Outcome outcome = run_program(arguments, in(folder));
    INFO(outcome.err);
    CHECK(outcome.exit_code == 0);
#ifndef RIDGECRAFT_SANITIZED
    // 7 to 9 s of work, however busy the machine is. It was 30 to 100, half of it in dividing the nets.
    CHECK(outcome.cpu_seconds < 17.0);
#endif
  }
}

TEST_CASE("a time limit that isn't reached changes nothing", "[limits]") {
  const TemporaryFolder folder;
  write_bytes(folder / "cube.off", cube_off);
  REQUIRE(run_program({"cube.off", "-o", "a"}, in(folder)).exit_code == 0);
  REQUIRE(run_program({"cube.off", "-o", "b", "--time-limit", "1000"}, in(folder)).exit_code == 0);
  CHECK(read_bytes(folder / "a/cube.fold") == read_bytes(folder / "b/cube.fold"));
}

TEST_CASE("without threads to be had the program does with one", "[limits]") {
  if (!can_drop_rights()) {
    WARN("skipped: only root can set this up");
    return;
  }
  const TemporaryFolder folder;
  write_bytes(folder / "sheet.off", wavy_sheet(6));
  write_bytes(folder / "long.off", wavy_sheet(250));
  fs::permissions(folder.path(), fs::perms::all);
  REQUIRE(run_program({"sheet.off", "-o", "many", "--threads", "8"}, in(folder)).exit_code == 0);
  RunOptions options = in(folder);
  options.most_threads = 1;
  // The search for leaks at the program's end, in builds that have it, needs a thread of its own.
  const WithoutLeakSearch without_leak_search;
  const Outcome outcome = run_program({"sheet.off", "-o", "one", "--threads", "8"}, options);
  INFO(outcome.err);
  REQUIRE(outcome.exit_code == 0);
  CHECK(read_bytes(folder / "many/sheet.fold") == read_bytes(folder / "one/sheet.fold"));

  // Interruption and time limit work all the same.
  CHECK(run_program({"long.off", "--time-limit", "0.05"}, options).exit_code == 130);
  options.interrupt_after_s = 0.4;
  const Outcome interrupted = run_program({"long.off", "--faces", "keep"}, options);
  CHECK(interrupted.exit_code == 130);
  CHECK_FALSE(interrupted.by_signal);
}

TEST_CASE("with --json a failure is one object, and a sentence beside it", "[limits]") {
  const TemporaryFolder folder;
  write_bytes(folder / "needle.obj",
              "v 0 0 0\nv 1 0 0\nv 0.5 1e-7 0\nv 0.5 0 1e-7\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n");
  write_bytes(folder / "cube.off", cube_off);
  const auto check = [&](const std::vector<std::string>& arguments, int code) {
    const Outcome outcome = run_program(arguments, in(folder));
    CAPTURE(outcome.out, outcome.err);
    CHECK(outcome.exit_code == code);
    const Json json = Json::parse(outcome.out);
    CHECK(json.size() == 1);
    CHECK(json["error"]["code"] == code);
    CHECK(outcome.err == "ridgecraft: " + json["error"]["message"].get<std::string>() + "\n");
  };
  check({"missing.obj", "--json"}, 3);
  check({"--json", "cube.off", "--size", "huge"}, 2);
  check({"cube.off", "--json", "-o", "x.docx"}, 2);
  check({"needle.obj", "--json"}, 5);
  check({"unfold", "needle.obj", "--json"}, 5);
  check({"segment", "missing.off", "--json"}, 3);
  check({"info", ".", "--json"}, 3);
  check({"verify", "missing.fold", "--json"}, 3);
  check({"cube.off", "--json", "-o", "/proc/nowhere/x.pdf"}, 7);
}

TEST_CASE("refusals of all verbs name the file", "[limits]") {
  const TemporaryFolder folder;
  write_bytes(folder / "cube.off", cube_off);
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"cube.off", "--scale", "1000000", "--unit", "mm"},
        {"unfold", "cube.off", "--scale", "1e9", "--unit", "mm"}}) {
    const Outcome outcome = run_program(arguments, in(folder));
    CHECK(outcome.exit_code == 5);
    CHECK(outcome.err.starts_with("ridgecraft: cube.off: "));
  }
}

TEST_CASE("sheets larger than a format can hold", "[limits]") {
  const TemporaryFolder folder;
  write_bytes(folder / "cube.off", cube_off);
  const Outcome pdf = run_program({"cube.off", "--paper", "6mx200mm"}, in(folder));
  CHECK(pdf.exit_code == 2);
  CHECK(pdf.err.find("PDF") != std::string::npos);
  CHECK(folder.names() == std::set<std::string>{"cube.off"});
  REQUIRE(run_program({"cube.off", "--paper", "19mx60mm", "--size", "20mm", "-o", "c.svg", "-o", "c.png"},
                      in(folder))
              .exit_code == 0);
  const std::string png = read_bytes(folder / "c.png");
  const auto number = [&](std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      value = value << 8U | static_cast<unsigned char>(png[at + i]);
    }
    return value;
  };
  // Width and height in the header; their ratio is the sheet's.
  CHECK(number(16) <= 32767);
  CHECK(static_cast<double>(number(16)) / number(20) == Approx(19000.0 / 60.0).epsilon(0.01));
}

TEST_CASE("info tells the repairs that the main job makes", "[limits]") {
  const TemporaryFolder folder;
  // A needle without area along one edge of the cube's first face.
  std::string bytes = cube_off;
  bytes.replace(bytes.find("8 6 0"), 5, "9 7 0");
  bytes.replace(bytes.find("4 3 2 1 0"), 0, "0.5 0 0\n");
  write_bytes(folder / "cube.off", bytes + "3 0 8 1\n");
  const Json info = Json::parse(run_program({"info", "cube.off", "--json"}, in(folder)).out);
  const Json paper = Json::parse(run_program({"cube.off", "--json"}, in(folder)).out);
  CHECK(info["repairs"].dump() == paper["repairs"].dump());
  CHECK_FALSE(info["repairs"].empty());
}
