// SPDX-License-Identifier: GPL-3.0-or-later
// What the next run tells of one that was killed.
#include <csignal>
#include <filesystem>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <catch2/catch.hpp>

#include "cli/files/set/pending_files.hpp"
#include "cli/killed_runs_checks.hpp"
#include "cli/program_checks.hpp"
#include "support/temporary_folder.hpp"

using namespace ridgecraft;
using namespace ridgecraft::test;
using cli::PendingFiles;
namespace fs = std::filesystem;

TEST_CASE("what a killed run had left is told in one sentence", "[killed]") {
  const TemporaryFolder folder(memory());
  leave_hidden_files(folder.path());
  CHECK(write_next(folder.path()) == Notes{"a run that was killed had left 2 hidden files in " +
                                           folder.path().string() + ", all removed now"});
  leave_hidden_files(folder.path(), 2);
  CHECK(write_next(folder.path()) == Notes{"2 runs that were killed had left 4 hidden files in " +
                                           folder.path().string() + ", all removed now"});
  CHECK(write_next(folder.path()).empty());
}

TEST_CASE("each verb that writes tells of what a killed run had left", "[killed]") {
  const TemporaryFolder folder;
  write_bytes(folder / "house.obj", house);
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{"house.obj", "--size", "8cm"},
                                                    {"unfold", "house.obj", "-o", "nets.fold"},
                                                    {"segment", "house.obj", "--labels", "labels.txt"},
                                                    {"hulls", "house.obj", "-o", "hulls.obj"},
                                                    {"shell", "house.obj", "-o", "shell.obj"}}) {
    CAPTURE(arguments);
    leave_hidden_files(folder.path());
    const Outcome outcome = run_program(arguments, in(folder));
    INFO(outcome.err);
    CHECK(outcome.exit_code == 0);
    CHECK(outcome.err.find("note: a run that was killed had left 2 hidden files in the current folder") !=
          std::string::npos);
    CHECK(hidden_in(folder.path()) == 0);
  }
}

TEST_CASE("a set that stays incomplete after a killed run is told, with the reason", "[killed]") {
  const TemporaryFolder folder(memory());
  const auto put_in_place_until = [&](std::string_view last_step) {
    write_bytes(folder / "x.svg", "old svg");
    fs::remove(folder / "x.pdf");
    REQUIRE_FALSE(in_child([&] {
      PendingFiles pending({.before_step = [last_step, renamed = 0](std::string_view step) mutable {
        if (step == last_step && renamed > 0) {
          ::raise(SIGKILL);
        }
        renamed += step == "rename" ? 1 : 0;
      }});
      pending.add(folder / "x.pdf", "new pdf");
      pending.add(folder / "x.svg", "new svg");
      pending.commit();
    }));
  };
  put_in_place_until("rename");
  write_bytes(folder / "x.svg", "edited by hand");
  Notes notes = write_next(folder.path());
  REQUIRE(notes.size() == 1);
  CHECK_THAT(notes[0], Catch::EndsWith("hadn't put all files of a set in place, which stays so: " +
                                       (folder / "x.svg").string() + " was changed since"));

  put_in_place_until("unlink");
  CHECK(read_bytes(folder / "x.svg") == "new svg");
  write_bytes(folder / "x.svg", "edited by hand");
  notes = write_next(folder.path());
  REQUIRE(notes.size() == 1);
  CHECK_THAT(notes[0], Catch::EndsWith("all removed now"));
  CHECK(read_bytes(folder / "x.svg") == "edited by hand");
}

TEST_CASE("a killed run's set that can't be put back is told", "[killed]") {
  const TemporaryFolder folder(memory());
  write_bytes(folder / "x.svg", "old svg");
  fs::create_directories(folder / "x.fold/inside");  // a folder can't be replaced by a file
  REQUIRE_FALSE(in_child([&] {
    PendingFiles pending({.before_step = [&, renamed = 0](std::string_view step) mutable {
      if (step == "rename" && ++renamed == 2) {
        for (const std::string& name : folder.names()) {
          if (name.ends_with(".old")) {
            fs::remove(folder / name);
          }
        }
        ::raise(SIGKILL);
      }
    }});
    pending.add(folder / "x.svg", "new svg");
    pending.add(folder / "x.fold", "new fold");
    pending.commit();
  }));
  const Notes notes = write_next(folder.path());
  REQUIRE(notes.size() == 1);
  CHECK_THAT(notes[0], Catch::EndsWith("all removed now, and had replaced some files of a set only: " +
                                       (folder / "x.svg").string() + " is new and can't be put back"));
  CHECK(hidden_in(folder.path()) == 0);
}

TEST_CASE("a set given up before anything was replaced isn't told as put back", "[killed]") {
  const TemporaryFolder folder(memory());
  write_bytes(folder / "x.svg", "old svg");
  REQUIRE_FALSE(in_child([&] {
    PendingFiles pending({.before_step = [](std::string_view step) {
      if (step == "link") {
        ::raise(SIGKILL);
      }
    }});
    pending.add(folder / "x.svg", "new svg");
    pending.commit();
  }));
  for (const std::string& name : folder.names()) {
    if (name.ends_with(".journal")) {
      write_bytes(folder / name, read_bytes(folder / name) + "back\n");
    }
  }
  const Notes notes = write_next(folder.path());
  REQUIRE(notes.size() == 1);
  CHECK_THAT(notes[0], Catch::EndsWith("all removed now"));
  CHECK(read_bytes(folder / "x.svg") == "old svg");
}

TEST_CASE("a run that fails tells of what a killed run had left, too", "[killed]") {
  const TemporaryFolder folder;
  write_bytes(folder / "house.obj", house);
  REQUIRE_FALSE(in_child([&] {
    PendingFiles pending({.before_step = [renamed = 0](std::string_view step) mutable {
      if (step == "rename" && renamed++ == 1) {
        ::raise(SIGKILL);
      }
    }});
    pending.add(folder / "x.pdf", "new pdf");
    pending.add(folder / "x.svg", "new svg");
    pending.commit();
  }));
  RunOptions options = in(folder);
  options.largest_file = 2000;
  const Outcome outcome = run_program({"house.obj"}, options);
  CHECK(outcome.exit_code == 7);
  CHECK(outcome.err.starts_with("note: a run that was killed had left "));
  CHECK(outcome.err.find("finished files that weren't all in place: they are now\n") != std::string::npos);
  CHECK(outcome.err.find("\nridgecraft: can't write ") != std::string::npos);
  CHECK(folder.names() == std::set<std::string>{"house.obj", "x.pdf", "x.svg"});
}
