// SPDX-License-Identifier: GPL-3.0-or-later
// Files that appear together or not at all.
#include "cli/files/set/pending_files.hpp"

#include <csignal>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <sys/resource.h>
#include <sys/stat.h>

#include "base/error.hpp"
#include "support/temporary_folder.hpp"

using namespace ridgecraft;
using cli::PendingFiles;
namespace fs = std::filesystem;

TEST_CASE("when one file can't get its name the others are as they were", "[pending]") {
  const test::TemporaryFolder folder;
  test::write_bytes(folder / "old", "before");
  fs::create_directories(folder / "busy/inside");
  {
    PendingFiles pending;
    pending.add(folder / "new", "1");
    pending.add(folder / "old", "2");
    pending.add(folder / "busy", "3");  // a folder can't be replaced by a file
    pending.add(folder / "last", "4");
    CHECK_THROWS_AS(pending.commit(), Error);
  }
  CHECK(test::read_bytes(folder / "old") == "before");
  CHECK(folder.names() == std::set<std::string>{"old", "busy"});
}

TEST_CASE("without second names, what can't be put back is named", "[pending]") {
  const test::TemporaryFolder folder;
  test::write_bytes(folder / "old", "before");
  fs::create_directories(folder / "busy/inside");
  {
    PendingFiles pending({.before_step = [&](std::string_view step) {
      if (step == "rename") {
        for (const std::string& name : folder.names()) {
          if (name.ends_with(".old")) {
            fs::remove(folder / name);
          }
        }
      }
    }});
    pending.add(folder / "new", "1");
    pending.add(folder / "old", "2");
    pending.add(folder / "busy", "3");  // a folder can't be replaced by a file
    CHECK_THROWS_WITH(pending.commit(), Catch::StartsWith("can't write " + (folder / "busy").string()) &&
                                            Catch::EndsWith("; " + (folder / "old").string() +
                                                            " is new already and couldn't be put back"));
  }
  CHECK(test::read_bytes(folder / "old") == "2");
  CHECK(folder.names() == std::set<std::string>{"old", "busy"});
}

TEST_CASE("files in new folders appear on commit, and nothing else stays", "[pending]") {
  const test::TemporaryFolder folder;
  test::write_bytes(folder / "old", "before");
  {
    PendingFiles pending;
    pending.add(folder / "a/b/new", "1");
    pending.add(folder / "old", "2");
    CHECK(test::read_bytes(folder / "old") == "before");
    CHECK(pending.commit().empty());
  }
  CHECK(test::read_bytes(folder / "a/b/new") == "1");
  CHECK(test::read_bytes(folder / "old") == "2");
  CHECK(folder.names() == std::set<std::string>{"old", "a"});
  {
    PendingFiles pending;
    pending.add(folder / "c/d/new", "1");
    pending.add(folder / "a/e/new", "1");
  }
  CHECK(folder.names() == std::set<std::string>{"old", "a"});
  CHECK_FALSE(fs::exists(folder / "a/e"));
}

TEST_CASE("new files have the rights that the user's mask leaves, and a link makes room", "[pending]") {
  const test::TemporaryFolder folder;
  test::write_bytes(folder / "old", "before");
  test::write_bytes(folder / "elsewhere", "before");
  fs::permissions(folder / "old", fs::perms::owner_read);
  fs::create_symlink("elsewhere", folder / "link");
  const mode_t mask = ::umask(027);
  PendingFiles pending;
  for (const char* name : {"new", "old", "link"}) {
    pending.add(folder / name, "after");
  }
  pending.commit();
  ::umask(mask);
  for (const char* name : {"new", "old", "link"}) {
    CHECK(fs::symlink_status(folder / name).permissions() ==
          (fs::perms::owner_read | fs::perms::owner_write | fs::perms::group_read));
    CHECK(test::read_bytes(folder / name) == "after");
  }
  CHECK(test::read_bytes(folder / "elsewhere") == "before");
}

TEST_CASE("a file that couldn't be written isn't put in place later", "[pending]") {
  const test::TemporaryFolder folder;
  PendingFiles pending;
  pending.add(folder / "one", "1");
  rlimit before{};
  REQUIRE(::getrlimit(RLIMIT_FSIZE, &before) == 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{100, before.rlim_max};
  REQUIRE(::setrlimit(RLIMIT_FSIZE, &small) == 0);
  CHECK_THROWS_AS(pending.add(folder / "two", std::string(1000, '2')), Error);
  REQUIRE(::setrlimit(RLIMIT_FSIZE, &before) == 0);
  std::signal(SIGXFSZ, handler);
  pending.commit();
  CHECK(folder.names() == std::set<std::string>{"one"});
}

TEST_CASE("a leftover that can't be removed is told, and no failure", "[pending]") {
  const test::TemporaryFolder folder;
  fs::create_directories(folder / "page-2.svg/inside");
  PendingFiles pending;
  pending.add(folder / "page.svg", "1");
  const std::vector<std::string> notes =
      pending.commit([&] { return std::vector<fs::path>{folder / "page-2.svg"}; });
  REQUIRE(notes.size() == 1);
  CHECK(notes[0].find("page-2.svg") != std::string::npos);
  CHECK(test::read_bytes(folder / "page.svg") == "1");
}

TEST_CASE("the disk gets each new folder's name before anything is put there", "[pending]") {
  const test::TemporaryFolder folder;
  std::vector<std::string> steps;
  PendingFiles pending({.before_step = [&](std::string_view step) { steps.emplace_back(step); }});
  pending.add(folder / "a/b/new", "1");
  REQUIRE(steps.size() > 4);
  CHECK(std::vector<std::string>(steps.begin(), steps.begin() + 4) ==
        std::vector<std::string>{"mkdir", "fsync", "mkdir", "fsync"});
}

TEST_CASE("a set in folders between which no path leads is refused", "[pending]") {
  const test::TemporaryFolder folder;
  {
    PendingFiles pending;
    pending.add(folder / "a/x", "1");
    pending.add(folder / "b/y", "1");
    fs::rename(folder / "b", folder / "c");
    fs::create_symlink("b", folder / "b");
    CHECK_THROWS_WITH(pending.commit(), Catch::Contains("no path leads from one to the other"));
    fs::remove(folder / "b");
    fs::rename(folder / "c", folder / "b");
  }
  CHECK(folder.names().empty());
}
