// SPDX-License-Identifier: GPL-3.0-or-later
// Files that appear when all of them are complete.
#include "cli/files/pending_files.hpp"

#include <barrier>
#include <csignal>
#include <string>
#include <thread>
#include <vector>

#include <catch2/catch.hpp>
#include <sys/resource.h>
#include <sys/stat.h>

#include "base/error.hpp"
#include "cli/program_checks.hpp"
#include "support/temporary_folder.hpp"

using namespace ridgecraft;
using cli::PendingFiles;
namespace fs = std::filesystem;

TEST_CASE("where one file can't be replaced the others are as they were", "[pending]") {
  const test::TemporaryFolder folder;
  test::write_bytes(folder / "old", "before");
  fs::create_directories(folder / "busy/inside");
  {
    PendingFiles pending;
    pending.add(folder / "new", "1");
    pending.add(folder / "old", "2");
    pending.add(folder / "busy", "3");  // a folder can't be replaced by a file
    CHECK_THROWS_AS(pending.commit(), Error);
  }
  CHECK(test::read_bytes(folder / "old") == "before");
  CHECK(folder.names() == std::set<std::string>{"old", "busy"});
}

TEST_CASE("where one file can't get its name, those that have theirs are named", "[pending]") {
  const test::TemporaryFolder folder;
  {
    PendingFiles pending;
    pending.add(folder / "one", "1");
    pending.add(folder / "two", "2");
    const std::set<std::string> before = folder.names();
    pending.add(folder / "three", "3");
    for (const std::string& name : folder.names()) {
      if (!before.contains(name)) {
        fs::remove(folder / name);
      }
    }
    CHECK_THROWS_WITH(pending.commit(),
                      Catch::StartsWith("can't write " + (folder / "three").string()) &&
                          Catch::EndsWith("; " + (folder / "two").string() + " is new already"));
  }
  // The first of a folder comes last.
  CHECK(folder.names() == std::set<std::string>{"two"});
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

TEST_CASE("two sets that race for one folder write whole files", "[pending]") {
  constexpr int rounds = 100;
  const std::vector<std::string> names{"a/x", "a/y", "b/z"};
  const test::TemporaryFolder folder(test::memory());
  std::size_t wrong = 0;
  std::barrier both(2, [&]() noexcept {
    for (const auto& [name, bytes] : test::contents(folder.path())) {
      wrong += name.ends_with(".part") || (bytes != std::string(99, '1') && bytes != std::string(99, '2'));
    }
    fs::remove_all(folder / "a");
    fs::remove_all(folder / "b");
  });
  const auto write = [&](char mark) {
    for (int i = 0; i < rounds; ++i) {
      both.arrive_and_wait();
      PendingFiles pending;
      for (const std::string& name : names) {
        pending.add(folder / name, std::string(99, mark));
      }
      pending.commit();
    }
    both.arrive_and_wait();
  };
  {
    const std::jthread first([&] { write('1'); });
    const std::jthread second([&] { write('2'); });
  }
  CHECK(wrong == 0);
}

TEST_CASE("two sets that make the same folder, of which one is given up", "[pending]") {
  const test::TemporaryFolder folder(test::memory());
  std::barrier both(2, [&]() noexcept { fs::remove_all(folder / "a"); });
  std::size_t failed = 0;
  const std::jthread other([&] {
    for (int i = 0; i < 300; ++i) {
      both.arrive_and_wait();
      PendingFiles given_up;
      given_up.add(folder / "a/b/y", "y");
    }
  });
  for (int i = 0; i < 300; ++i) {
    both.arrive_and_wait();
    try {
      PendingFiles pending;
      pending.add(folder / "a/b/x", "x");
      pending.commit();
    } catch (const Error&) {
      ++failed;
    }
  }
  CHECK(failed == 0);
}

TEST_CASE("hundreds of files at a time", "[pending][slow]") {
  const test::TemporaryFolder folder;
  test::write_bytes(folder / "house.obj", test::house);
  const test::Outcome outcome = test::run_command(
      {"/bin/sh", "-c",
       "ulimit -n 64; exec " RIDGECRAFT_PROGRAM " house.obj --size 1m --no-guide -o x.svg --faces keep"},
      test::in(folder));
  INFO(outcome.err);
  CHECK(outcome.exit_code == 0);
  CHECK(folder.names().size() > 70);
}
