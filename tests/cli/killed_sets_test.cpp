// SPDX-License-Identifier: GPL-3.0-or-later
// A run that is killed before any of its steps leaves one whole set of files: the old one or the new one.
#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>

#include <catch2/catch.hpp>

#include "base/error.hpp"
#include "cli/files/set/pending_files.hpp"
#include "cli/killed_runs_checks.hpp"
#include "support/temporary_folder.hpp"

using namespace ridgecraft;
using namespace ridgecraft::test;
using cli::PendingFiles;
namespace fs = std::filesystem;

TEST_CASE("a run killed before any step leaves one whole set after the next run", "[killed]") {
  const BothSets sets = both_sets();
  const int count = static_cast<int>(sets.steps.size());
  REQUIRE(std::count(sets.steps.begin(), sets.steps.end(), "rename") == 3);
  bool forward = false;
  for (int step = 0; step < count; ++step) {
    CAPTURE(step, sets.steps[static_cast<std::size_t>(step)]);
    const TemporaryFolder folder(memory());
    write_old_set(folder.path());
    REQUIRE_FALSE(in_child([&] { write_new_set(folder.path(), death_at(step)); }));
    const bool to_be_told = is_to_be_told(folder / "a");
    const Notes notes = write_next(folder / "a");
    CHECK(notes.size() == (to_be_told ? 1 : 0));
    CHECK(hidden_in(folder / "a") == 0);
    const Contents now = visible(folder.path());
    CHECK((now == sets.before || now == sets.after));
    CHECK((now == sets.after || !forward));
    forward = now == sets.after;
    write_next(folder / "b");
    CHECK(hidden_in(folder.path()) == 0);
    CHECK(visible(folder.path()) == now);
  }
  CHECK(forward);
}

TEST_CASE("a run killed while it clears up leaves one whole set all the same", "[killed][slow]") {
  const BothSets sets = both_sets();
  for (std::size_t renaming = 0; renaming < sets.steps.size(); ++renaming) {
    if (sets.steps[renaming] != "rename") {
      continue;
    }
    bool killed = true;
    for (int step = 0; killed; ++step) {
      CAPTURE(renaming, step);
      const TemporaryFolder folder(memory());
      write_old_set(folder.path());
      REQUIRE_FALSE(in_child([&] { write_new_set(folder.path(), death_at(static_cast<int>(renaming))); }));
      killed = !in_child([&] { write_next(folder / "b", death_at(step)); });
      write_next(folder / "a");
      write_next(folder / "b");
      CHECK(visible(folder.path()) == sets.after);
      CHECK(hidden_in(folder.path()) == 0);
    }
  }
}

TEST_CASE("a run killed while it puts files back leaves the old set", "[killed]") {
  bool killed = true;
  for (int step = 0; killed; ++step) {
    CAPTURE(step);
    const TemporaryFolder folder(memory());
    write_bytes(folder / "x.svg", "old svg");
    fs::create_directories(folder / "x.fold/inside");  // a folder can't be replaced by a file
    killed = !in_child([&] {
      PendingFiles pending({.before_step = death_at(step)});
      pending.add(folder / "x.pdf", "new pdf");
      pending.add(folder / "x.svg", "new svg");
      pending.add(folder / "x.fold", "new fold");
      try {
        pending.commit();
      } catch (const Error&) {
        return;
      }
      ::raise(SIGKILL);
    });
    write_next(folder.path());
    CHECK(visible(folder.path()) == Contents{{"x.svg", "old svg"}});
    CHECK(hidden_in(folder.path()) == 0);
  }
}

TEST_CASE("a file that somebody has changed since isn't touched when a killed run is cleared up",
          "[killed]") {
  const BothSets sets = both_sets();
  for (std::size_t step = 0; step < sets.steps.size(); ++step) {
    CAPTURE(step);
    const TemporaryFolder folder(memory());
    write_old_set(folder.path());
    REQUIRE_FALSE(in_child([&] { write_new_set(folder.path(), death_at(static_cast<int>(step))); }));
    write_bytes(folder / "a/x.svg", "edited by hand");
    fs::remove(folder / "b/x.fold");
    write_next(folder / "a");
    write_next(folder / "b");
    CHECK(read_bytes(folder / "a/x.svg") == "edited by hand");
    CHECK_FALSE(fs::exists(folder / "b/x.fold"));
    CHECK(hidden_in(folder.path()) == 0);
  }
}

TEST_CASE("a killed run's set waits for a folder that can't be reached, for an hour", "[killed]") {
  const BothSets sets = both_sets();
  for (std::size_t step = 0; step < sets.steps.size(); ++step) {
    for (const auto& [here, there] : {std::pair("a", "b"), std::pair("b", "a")}) {
      CAPTURE(step, here);
      const TemporaryFolder folder(memory());
      write_old_set(folder.path());
      REQUIRE_FALSE(in_child([&] { write_new_set(folder.path(), death_at(static_cast<int>(step))); }));
      fs::rename(folder / there, folder / "elsewhere");
      write_next(folder / here);
      fs::rename(folder / "elsewhere", folder / there);
      write_next(folder / here);
      write_next(folder / there);
      const Contents now = visible(folder.path());
      CHECK((now == sets.before || now == sets.after));
      CHECK(hidden_in(folder.path()) == 0);
    }
  }

  const TemporaryFolder folder(memory());
  REQUIRE_FALSE(in_child([&] {
    PendingFiles pending({.before_step = [](std::string_view step) {
      if (step == "rename") {
        ::raise(SIGKILL);
      }
    }});
    pending.add(folder / "a/x.pdf", "new pdf");
    pending.add(folder / "b/x.fold", "new fold");
    pending.commit();
  }));
  fs::remove_all(folder / "b");
  write_next(folder / "a");
  CHECK(hidden_in(folder / "a") > 0);
  for (const auto& entry : fs::directory_iterator(folder / "a")) {
    fs::last_write_time(entry, fs::file_time_type::clock::now() - std::chrono::minutes(61));
  }
  write_next(folder / "a");
  CHECK(hidden_in(folder / "a") == 0);
}
