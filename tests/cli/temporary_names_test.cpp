// SPDX-License-Identifier: GPL-3.0-or-later
// Names of hidden files: ours beyond doubt.
#include "cli/files/set/temporary_names.hpp"

#include <set>

#include <catch2/catch.hpp>
#include <unistd.h>

using namespace ridgecraft::cli;

TEST_CASE("ids never repeat, and don't come from the process id", "[names]") {
  std::set<RunId> ids;
  for (int i = 0; i < 1000; ++i) {
    ids.insert(new_run_id(this_kernel()));
  }
  CHECK(ids.size() == 1000);
  for (const RunId& id : ids) {
    CHECK(id.size() == 32);
    CHECK(kernel_of(id) == this_kernel());
  }
}

TEST_CASE("hidden files are known by their names, whole names only", "[names]") {
  const RunId id = new_run_id(unknown_kernel);
  CHECK(kernel_of(id) == unknown_kernel);
  for (const std::string& name :
       {journal_name(id), part_name(id, 0), part_name(id, 12345), old_name(id, 0), old_name(id, 7)}) {
    CAPTURE(name);
    CHECK(name.starts_with('.'));
    CHECK(run_of(name) == id);
    CHECK_FALSE(run_of(name + "x"));
    CHECK_FALSE(run_of("x" + name));
    CHECK_FALSE(run_of(name.substr(0, name.size() - 1)));
  }
  for (const std::string& name :
       {std::string(), std::string("."), std::string(lock_name), std::string(".ridgecraft-notes.part"),
        std::string(".ridgecraft-1-0.part"), ".ridgecraft-" + id, ".ridgecraft-" + id + "-.part",
        ".ridgecraft-" + id + "-00.part", ".ridgecraft-" + id + "-1.journal", ".ridgecraft-" + id + "-a.old",
        ".ridgecraft-" + id + "-1234567890.part", ".ridgecraft-" + std::string(32, 'A') + ".journal"}) {
    CAPTURE(name);
    CHECK_FALSE(run_of(name));
  }
}
