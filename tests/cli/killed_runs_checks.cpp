// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/killed_runs_checks.hpp"

#include <algorithm>
#include <csignal>
#include <list>
#include <memory>
#include <string_view>

#include <catch2/catch.hpp>
#include <sys/wait.h>
#include <unistd.h>

#include "cli/files/set/temporary_names.hpp"

namespace ridgecraft::test {

using cli::PendingFiles;
namespace fs = std::filesystem;

namespace {

bool is_hidden(const std::string& file) {
  return fs::path(file).filename().string().starts_with('.');
}

}  // namespace

bool is_to_be_told(const fs::path& folder) {
  Contents all = contents(folder);
  std::erase_if(all, [](const auto& file) {
    return !is_hidden(file.first) || (file.first == cli::lock_name && file.second.empty());
  });
  return !all.empty();
}

std::size_t hidden_in(const fs::path& folder) {
  std::size_t count = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    count += is_hidden(entry.path().string()) ? 1U : 0U;
  }
  return count;
}

Contents visible(const fs::path& folder) {
  Contents all = contents(folder);
  std::erase_if(all, [](const auto& file) { return is_hidden(file.first) || file.first.ends_with("next"); });
  return all;
}

cli::BeforeStep death_at(int step) {
  return [left = std::make_shared<int>(step)](std::string_view) {
    if ((*left)-- == 0) {
      ::raise(SIGKILL);
    }
  };
}

bool in_child(const std::function<void()>& work) {
  const pid_t child = ::fork();
  if (child == 0) {
    try {
      work();
    } catch (...) {
      ::_exit(1);
    }
    ::_exit(0);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

void write_old_set(const fs::path& folder) {
  PendingFiles pending;
  pending.add(folder / "a/x.svg", "old svg");
  pending.add(folder / "a/x-2.svg", "old second page");
  pending.add(folder / "b/x.fold", "old fold");
  pending.commit();
}

void write_new_set(const fs::path& folder, const cli::BeforeStep& before_step) {
  PendingFiles pending({.before_step = before_step});
  pending.add(folder / "a/x.pdf", "new pdf");
  pending.add(folder / "a/x.svg", "new svg");
  pending.add(folder / "b/x.fold", "new fold");
  pending.commit([&] { return std::vector<fs::path>{folder / "a/x-2.svg"}; });
}

Notes write_next(const fs::path& folder, const cli::BeforeStep& before_step) {
  PendingFiles pending({.before_step = before_step});
  pending.add(folder / "next", "next");
  return pending.commit();
}

BothSets both_sets() {
  const TemporaryFolder folder(memory());
  BothSets sets;
  write_old_set(folder.path());
  sets.before = visible(folder.path());
  write_new_set(folder.path(), [&](std::string_view step) { sets.steps.emplace_back(step); });
  sets.after = visible(folder.path());
  REQUIRE(sets.after.size() == 3);
  REQUIRE(hidden_in(folder.path()) == 0);
  return sets;
}

void leave_hidden_files(const fs::path& folder, int runs) {
  REQUIRE_FALSE(in_child([&] {
    std::list<PendingFiles> pending;
    for (int i = 0; i < runs; ++i) {
      pending.emplace_back().add(folder / "x.pdf", "new pdf");
    }
    ::raise(SIGKILL);
  }));
}

}  // namespace ridgecraft::test
