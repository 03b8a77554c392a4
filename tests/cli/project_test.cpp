// SPDX-License-Identifier: GPL-3.0-or-later
// A project opens to the bytes that it was saved with, and options that are given go before its own.
#include <filesystem>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "cli/program_checks.hpp"
#include "session/project_file.hpp"
#include "support/temporary_folder.hpp"

using namespace ridgecraft;
using namespace ridgecraft::test;
namespace fs = std::filesystem;

namespace {

const std::string house_sample = std::string(RIDGECRAFT_SOURCE_DIR) + "/samples/house.obj";

Outcome run_well(const std::vector<std::string>& words, const TemporaryFolder& folder) {
  Outcome outcome = run_program(words, in(folder));
  INFO(outcome.err);
  REQUIRE(outcome.exit_code == 0);
  return outcome;
}

/// A project with these edits, in a file.
void write_project(const fs::path& file, const fs::path& from, const std::string& edits) {
  session::ProjectFile project = session::read_project("house", read_bytes(from));
  project.edits = edits;
  write_bytes(file, session::write_project(project));
}

}  // namespace

TEST_CASE("a project and a page give the bytes of before", "[program]") {
  const TemporaryFolder folder;
  run_well({house_sample, "--size", "120mm", "--paper", "A5", "-o", "a", "-o", "a/house.ridgecraft"}, folder);
  const std::string opened = GENERATE("a/house.ridgecraft", "a/house.html");
  run_well({opened, "-o", "b", "-o", "b/house.ridgecraft"}, folder);
  std::size_t files = 0;
  for (const auto& entry : fs::directory_iterator(folder / "a")) {
    INFO(entry.path());
    CHECK(read_bytes(entry.path()) == read_bytes(folder / "b" / entry.path().filename()));
    ++files;
  }
  CHECK(files >= 6);

  // Options of the command line go first.
  run_well({opened, "--size=20cm", "-o", "c.fold"}, folder);
  run_well({house_sample, "--size", "20cm", "--paper", "A5", "-o", "d.fold"}, folder);
  CHECK(read_bytes(folder / "c.fold") == read_bytes(folder / "d.fold"));

  // A project may be saved where it lies.
  run_well({"b/house.ridgecraft", "--size=20cm", "--overwrite", "-o", "b/house.ridgecraft"}, folder);
  run_well({"b/house.ridgecraft", "-o", "g.fold"}, folder);
  CHECK(read_bytes(folder / "g.fold") == read_bytes(folder / "c.fold"));

  // Cuts are taken over from it as from its nets.
  run_well({house_sample, "--from", opened, "-o", "e.fold"}, folder);
  run_well({house_sample, "--from", "a/house.fold", "-o", "f.fold"}, folder);
  CHECK(read_bytes(folder / "e.fold") == read_bytes(folder / "f.fold"));
}

TEST_CASE("edits in a project are done again, and those that can't be are told", "[program]") {
  const TemporaryFolder folder;
  run_well({house_sample, "-o", "plain.ridgecraft", "-o", "plain.fold"}, folder);
  write_project(folder / "pinned.ridgecraft", folder / "plain.ridgecraft", "pin 0");
  run_well({"pinned.ridgecraft", "-o", "pinned.fold", "-o", "again.ridgecraft"}, folder);
  CHECK(read_bytes(folder / "pinned.fold").find("\"edits\": \"pin 0\"") != std::string::npos);
  CHECK(session::read_project("again", read_bytes(folder / "again.ridgecraft")).edits == "pin 0");

  write_project(folder / "stale.ridgecraft", folder / "plain.ridgecraft", "cut 99998 99999");
  const Outcome stale = run_well({"stale.ridgecraft", "-o", "stale.fold"}, folder);
  CHECK(stale.err.find("1 change by hand can't be made on these nets and is left out") != std::string::npos);
  CHECK(read_bytes(folder / "stale.fold") == read_bytes(folder / "plain.fold"));
}

TEST_CASE("two files of one name can't be in a project, and a page does without one", "[program]") {
  const TemporaryFolder folder;
  fs::create_directory(folder / "other");
  write_bytes(folder / "house.obj", read_bytes(house_sample));
  write_bytes(folder / "other/house.obj", "cut 0 1\n");
  const Outcome refused =
      run_program({"house.obj", "--cuts", "other/house.obj", "-o", "x.ridgecraft"}, in(folder));
  INFO(refused.err);
  CHECK(refused.exit_code != 0);
  CHECK_FALSE(fs::exists(folder / "x.ridgecraft"));
}

TEST_CASE("files of a project go when one of them can't be written", "[program]") {
  const TemporaryFolder folder;
  run_well({house_sample, "-o", "a.ridgecraft"}, folder);
  fs::create_directory(folder / "tmp");
  RunOptions options = in(folder);
  options.largest_file = 1000;
  const Outcome failed =
      run_command({"env", "TMPDIR=tmp", RIDGECRAFT_PROGRAM, "a.ridgecraft", "-o", "a.fold"}, options);
  INFO(failed.err);
  CHECK(failed.err.find("can't write tmp/") != std::string::npos);
  CHECK(fs::is_empty(folder / "tmp"));
}

TEST_CASE("what is no project is refused with a sentence", "[program]") {
  const TemporaryFolder folder;
  run_well({house_sample, "-o", "whole.ridgecraft"}, folder);
  write_bytes(folder / "half.ridgecraft", read_bytes(folder / "whole.ridgecraft").substr(0, 2000));
  const Outcome half = run_program({"half.ridgecraft"}, in(folder));
  CHECK(half.exit_code == 3);
  CHECK(half.err.find("half.ridgecraft is cut off or damaged") != std::string::npos);
  // A file of somebody else's can't say where results go.
  for (const char* const word : {"--output=elsewhere.pdf", "--overwrite", "--nonsense", "other.obj"}) {
    session::ProjectFile project = session::read_project("whole", read_bytes(folder / "whole.ridgecraft"));
    project.words = {word};
    write_bytes(folder / "bad.ridgecraft", session::write_project(project));
    const Outcome bad = run_program({"bad.ridgecraft", "-o", "bad.fold"}, in(folder));
    CHECK(bad.exit_code == 3);
    CHECK(bad.err.find("bad.ridgecraft is a damaged project") != std::string::npos);
  }
  CHECK(run_program({"-", "-o", "x.ridgecraft"}, in(folder)).exit_code != 0);
}
