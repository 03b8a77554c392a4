// SPDX-License-Identifier: GPL-3.0-or-later
// Files that appear together or not at all.
#include "cli/files/pending_files.hpp"

#include <catch2/catch.hpp>

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

TEST_CASE("a leftover that can't be removed is told, and no failure", "[pending]") {
  const test::TemporaryFolder folder;
  fs::create_directories(folder / "page-2.svg/inside");
  PendingFiles pending;
  pending.add(folder / "page.svg", "1");
  pending.remove_on_commit(folder / "page-2.svg");
  const std::vector<std::string> notes = pending.commit();
  REQUIRE(notes.size() == 1);
  CHECK(notes[0].find("page-2.svg") != std::string::npos);
  CHECK(test::read_bytes(folder / "page.svg") == "1");
}
