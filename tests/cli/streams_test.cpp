// SPDX-License-Identifier: GPL-3.0-or-later
// The standard streams: a model that comes through one, results that don't get out through another.
#include <array>
#include <cstdlib>

#include <catch2/catch.hpp>
#include <fcntl.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "cli/program_checks.hpp"
#include "support/temporary_folder.hpp"

using namespace ridgecraft::test;
namespace fs = std::filesystem;
using Json = nlohmann::json;

namespace {

/// A line for the shell in which PROGRAM stands for the program.
Outcome run_line(std::string line, const TemporaryFolder& folder) {
  const std::string word = "PROGRAM";
  for (std::size_t at = line.find(word); at != std::string::npos; at = line.find(word)) {
    line.replace(at, word.size(), RIDGECRAFT_PROGRAM);
  }
  return run_command({"/bin/sh", "-c", line}, in(folder));
}

/// The exit code that a line left in the file `code`, where the shell tells only that of a pipe's end.
int code_in(const TemporaryFolder& folder) {
  return std::stoi(read_bytes(folder / "code"));
}

/// A terminal of our own.
class Terminal {
 public:
  Terminal() : master_(::posix_openpt(O_RDWR | O_NOCTTY)) {
    REQUIRE(master_ >= 0);
    REQUIRE(::grantpt(master_) == 0);
    REQUIRE(::unlockpt(master_) == 0);
    std::array<char, 64> name{};
    REQUIRE(::ptsname_r(master_, name.data(), name.size()) == 0);
    name_ = name.data();
  }
  ~Terminal() { ::close(master_); }
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;
  [[nodiscard]] const std::string& name() const { return name_; }

 private:
  int master_;
  std::string name_;
};

}  // namespace

TEST_CASE("exit code 8: all files are there, but the summary didn't get out", "[streams][slow]") {
  const TemporaryFolder folder;
  write_bytes(folder / "house.obj", house);
  const auto check_told = [&](int code, const Outcome& outcome, const std::string& file) {
    CAPTURE(outcome.err);
    CHECK(code == 8);
    CHECK(outcome.err.find("the files were written, but the summary couldn't be printed: standard output") !=
          std::string::npos);
    CHECK(fs::exists(folder / file));
  };
  Outcome outcome = run_line("PROGRAM house.obj -o closed.pdf >&-", folder);
  check_told(outcome.exit_code, outcome, "closed.pdf");
  CHECK(outcome.err.find("standard output is closed") != std::string::npos);
  outcome = run_line("{ PROGRAM house.obj -o unread.pdf; echo $? >code; } | :", folder);
  check_told(code_in(folder), outcome, "unread.pdf");
  if (fs::exists("/dev/full")) {
    outcome = run_line("PROGRAM house.obj -o full.pdf >/dev/full", folder);
    check_told(outcome.exit_code, outcome, "full.pdf");
    for (const char* arguments : {"house.obj --json -o a.pdf", "unfold house.obj -o a.fold",
                                  "segment house.obj -o a.ply", "hulls house.obj -o a.obj"}) {
      CAPTURE(arguments);
      outcome = run_line(std::string("PROGRAM ") + arguments + " >/dev/full", folder);
      check_told(outcome.exit_code, outcome, "house.obj");
    }
    // Where nothing but the text was asked for, it is the result.
    for (const char* arguments : {"info house.obj", "segment house.obj", "--help", "formats --json"}) {
      CAPTURE(arguments);
      outcome = run_line(std::string("PROGRAM ") + arguments + " >/dev/full", folder);
      CHECK(outcome.exit_code == 7);
      CHECK(outcome.err.find("can't print the result") != std::string::npos);
    }
  }
  CHECK(run_line("PROGRAM house.obj -q -o quiet.pdf >&-", folder).exit_code == 0);
}

TEST_CASE("who closes a pipe has read enough", "[streams]") {
  const TemporaryFolder folder;
  write_bytes(folder / "house.obj", house);
  REQUIRE(run_program({"unfold", "house.obj", "-o", "h.fold"}, in(folder)).exit_code == 0);
  for (const char* arguments :
       {"help", "--help", "--man-page", "formats", "info house.obj", "verify h.fold", "segment house.obj"}) {
    CAPTURE(arguments);
    const Outcome outcome = run_line("{ sleep 0.1; PROGRAM " + std::string(arguments) + " -q; PROGRAM " +
                                         arguments + "; echo $? >code; } 2>errors | :",
                                     folder);
    CHECK(code_in(folder) == 0);
    CHECK(read_bytes(folder / "errors").find("output") == std::string::npos);
  }
  write_bytes(folder / "no.fold", "{}");
  static_cast<void>(run_line("{ sleep 0.1; PROGRAM verify no.fold; echo $? >code; } | :", folder));
  CHECK(code_in(folder) == 6);
}

TEST_CASE("a model comes through standard input", "[streams][slow]") {
  const TemporaryFolder folder;
  write_bytes(folder / "red.mtl", "newmtl red\nKd 1 0 0\n");
  write_bytes(folder / "house.obj", "mtllib red.mtl\nmtllib missing.mtl\nusemtl red\n" + std::string(house));
  SECTION("for the main job, whose results are called model") {
    const Outcome outcome = run_line("cat house.obj | PROGRAM -", folder);
    INFO(outcome.err);
    REQUIRE(outcome.exit_code == 0);
    CHECK(outcome.out.starts_with("standard input: 7 polygons"));
    for (const char* file : {"model.pdf", "model.fold"}) {
      CHECK(fs::exists(folder / file));
    }
    CHECK(run_program({"verify", "model.fold"}, in(folder)).exit_code == 0);
    // The same bytes leave the same mark, so the same model replaces its files, and no other one does.
    CHECK(run_line("PROGRAM - <house.obj", folder).exit_code == 0);
    CHECK(run_line("grep -v '^f 4 3' house.obj | PROGRAM -", folder).exit_code == 7);
  }
  SECTION("for every verb") {
    REQUIRE(run_program({"cage", "house.obj", "-o", "cage.obj"}, in(folder)).exit_code == 0);
    for (const char* line : {"info -", "segment - -o parts.ply", "unfold - -o nets.fold",
                             "hulls - -o hulls.obj", "cage - -o other.obj", "shell - -o shell.ply",
                             "deform - --cage cage.obj --to cage.obj -o moved.obj", "-o pages -- -"}) {
      CAPTURE(line);
      const Outcome outcome = run_line(std::string("PROGRAM ") + line + " <house.obj", folder);
      INFO(outcome.err);
      CHECK(outcome.exit_code == 0);
      CHECK(outcome.out.starts_with("standard input: "));
    }
    CHECK(fs::exists(folder / "pages/model.pdf"));
  }
  SECTION("and nothing lies beside it") {
    const Json file = Json::parse(run_line("PROGRAM info house.obj --json", folder).out);
    const Json stream = Json::parse(run_line("PROGRAM info - --json <house.obj", folder).out);
    CHECK(file["repairs"].dump().find("material") != std::string::npos);
    CHECK(stream["repairs"].dump().find("material") == std::string::npos);
    CHECK(stream["model"] == "model");
  }
  SECTION("together with files of edges and nets") {
    write_bytes(folder / "cuts.txt", "9 10\n");
    const Outcome cut = run_line("PROGRAM - --cuts cuts.txt -o cut.fold <house.obj", folder);
    INFO(cut.err);
    REQUIRE(cut.exit_code == 0);
    CHECK(run_line("PROGRAM - --from cut.fold -o again.fold <house.obj", folder).exit_code == 0);
    write_bytes(folder / "cuts.txt", "0 9\n");
    check_refusal(run_line("PROGRAM - --cuts cuts.txt <house.obj", folder), 3, "cuts.txt, line 1");
  }
  SECTION("and is refused with its name") {
    fs::create_directory(folder / "folder");
    write_bytes(folder / "empty.obj", "");
    check_refusal(run_line("PROGRAM - <folder", folder), 3, "standard input is a folder, not a file");
    check_refusal(run_line("PROGRAM - <empty.obj", folder), 3, "standard input is empty");
    check_refusal(run_line("PROGRAM - </dev/null", folder), 3, "standard input is empty");
    check_refusal(run_line("PROGRAM - </dev/zero", folder), 3, "standard input is a device");
    check_refusal(run_line("PROGRAM - <&-", folder), 3, "standard input is closed");
    check_refusal(run_line("echo hello | PROGRAM info -", folder), 3,
                  "standard input is in no known mesh format");
    check_refusal(run_line("echo v 0 0 0 | PROGRAM info -", folder), 4, "standard input has");
    check_refusal(run_line("PROGRAM - --scale 1000000 --unit mm <house.obj", folder), 5,
                  "ridgecraft: standard input: the model would be larger");
    const Terminal terminal;
    check_refusal(run_line("PROGRAM - <" + terminal.name(), folder), 3, "standard input is the terminal");
  }
}

TEST_CASE("waiting for standard input ends with the time limit", "[streams]") {
  const TemporaryFolder folder;
  const Outcome outcome = run_line(
      "sleep 3 | { PROGRAM info - --time-limit 0.2; echo $? >code; date +%s >ended; }; date +%s >all",
      folder);
  CHECK(code_in(folder) == 130);
  CHECK(outcome.err.find("--time-limit passed while standard input was read") != std::string::npos);
  CHECK(std::stol(read_bytes(folder / "ended")) < std::stol(read_bytes(folder / "all")));
}

TEST_CASE("the option -q leaves out what isn't the result itself", "[streams]") {
  const TemporaryFolder folder;
  write_bytes(folder / "house.obj", house);
  for (const std::vector<std::string>& arguments :
       std::vector<std::vector<std::string>>{{"info", "house.obj"}, {"formats"}}) {
    std::vector<std::string> quiet = arguments;
    quiet.emplace_back("-q");
    const Outcome outcome = run_program(quiet, in(folder));
    CHECK(outcome.exit_code == 0);
    CHECK(outcome.out == run_program(arguments, in(folder)).out);
    CHECK(outcome.err.empty());
  }
  for (const char* verb : {"segment", "unfold"}) {
    const Outcome outcome = run_program({verb, "house.obj", "-q"}, in(folder));
    CHECK(outcome.exit_code == 0);
    CHECK(outcome.out.starts_with("house.obj: "));
    CHECK(outcome.err.empty());
  }
  CHECK(folder.names() == std::set<std::string>{"house.obj"});
  CHECK(run_program({"unfold", "house.obj", "-q", "-o", "h.fold"}, in(folder)).out.empty());
  const Outcome verified = run_program({"verify", "h.fold", "-q"}, in(folder));
  CHECK(verified.exit_code == 0);
  CHECK(verified.out.empty());
}

TEST_CASE("options end at --", "[streams]") {
  const TemporaryFolder folder;
  write_bytes(folder / "-wheel.obj", house);
  write_bytes(folder / "info", house);
  check_refusal(run_program({"-wheel.obj"}, in(folder)), 2, "there is no option");
  CHECK(run_program({"-o", "out", "--", "-wheel.obj"}, in(folder)).exit_code == 0);
  CHECK(fs::exists(folder / "out/-wheel.pdf"));
  CHECK(run_program({"info", "--", "-wheel.obj"}, in(folder)).exit_code == 0);
  CHECK(run_program({"--", "info"}, in(folder)).out.starts_with("info: 7 polygons"));
  // What follows is no option, nor a wish for JSON.
  check_refusal(run_program({"info", "--", "-wheel.obj", "--json"}, in(folder)), 2,
                "'--json' is one argument too many behind --");
}
