// SPDX-License-Identifier: GPL-3.0-or-later
// A run that is killed leaves old or new files, whole ones; the next one removes the rest.
#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <sys/wait.h>
#include <unistd.h>
#ifdef __linux__
#include <sys/ptrace.h>
#endif

#include "base/random.hpp"
#include "cli/files/pending_files.hpp"
#include "cli/program_checks.hpp"
#include "support/temporary_folder.hpp"

using namespace ridgecraft;
using namespace ridgecraft::test;
using cli::PendingFiles;
namespace fs = std::filesystem;

namespace {

const Contents old_set{{"a/x.svg", "old svg"}, {"a/x-2.svg", "old page"}, {"b/x.fold", "old fold"}};
const Contents new_set{{"a/x.pdf", "new pdf"}, {"a/x.svg", "new svg"}, {"b/x.fold", "new fold"}};

void write_set(const fs::path& folder, const Contents& files, const PendingFiles::LastLook& leftovers = {}) {
  PendingFiles pending;
  for (const auto& [name, bytes] : files) {
    pending.add(folder / name, bytes);
  }
  pending.commit(leftovers);
}

/// Writes the new set over the old one.
void replace_set(const fs::path& folder) {
  write_set(folder, new_set, [&] { return std::vector<fs::path>{folder / "a/x-2.svg"}; });
}

std::size_t parts_in(const fs::path& folder) {
  std::size_t count = 0;
  for (const auto& [name, bytes] : contents(folder)) {
    count += name.ends_with(".part") ? 1U : 0U;
  }
  return count;
}

/// All files but those of killed runs are of one of the sets, unless the next run wrote them.
bool all_whole(const Contents& found) {
  for (const auto& [name, bytes] : found) {
    const auto is_in = [&](const Contents& set) { return set.contains(name) && set.at(name) == bytes; };
    if (!is_in(old_set) && !is_in(new_set) && !name.ends_with("/next")) {
      return false;
    }
  }
  return true;
}

/// Leaves two `.part` in the folder.
void leave_part(const fs::path& folder) {
  const pid_t child = ::fork();
  if (child == 0) {
    PendingFiles pending;
    pending.add(folder / "x.pdf", "new pdf");
    pending.add(folder / "x.dxf", "new dxf");
    ::raise(SIGKILL);
  }
  ::waitpid(child, nullptr, 0);
  REQUIRE(parts_in(folder) == 2);
}

#ifdef __linux__
/// Does the work in a process of its own that is killed at its system call of this number (each is seen
/// twice, before and after). False when the work came to its end, nothing where processes can't be watched.
std::optional<bool> killed_at(int call, const std::function<void()>& work) {
  const pid_t child = ::fork();
  if (child == 0) {
    if (::ptrace(PTRACE_TRACEME, 0, nullptr, nullptr) != 0) {
      ::_exit(77);
    }
    ::raise(SIGSTOP);
    work();
    ::_exit(0);
  }
  int status = 0;
  for (::waitpid(child, &status, 0); WIFSTOPPED(status); ::waitpid(child, &status, 0)) {
    if (call-- == 0) {
      ::kill(child, SIGKILL);
      ::waitpid(child, &status, 0);
      return true;
    }
    ::ptrace(PTRACE_SYSCALL, child, nullptr, nullptr);
  }
  return WIFEXITED(status) && WEXITSTATUS(status) == 77 ? std::nullopt : std::optional(false);
}
#endif

}  // namespace

#ifdef __linux__
TEST_CASE("a run killed at any system call leaves whole files", "[killed]") {
  bool killed = true;
  std::size_t left = 0;
  for (int call = 0; killed; ++call) {
    CAPTURE(call);
    const TemporaryFolder folder(memory());
    write_set(folder.path(), old_set);
    const auto outcome = killed_at(call, [&] { replace_set(folder.path()); });
    if (!outcome) {
      WARN("skipped: processes can't be watched here");
      return;
    }
    killed = *outcome;
    left += parts_in(folder.path());
    write_set(folder.path(), {{"a/next", "1"}, {"b/next", "1"}});
    const Contents found = contents(folder.path());
    CHECK(all_whole(found));
    CHECK(found.contains("a/x.svg"));
    CHECK(found.contains("b/x.fold"));
    CHECK((killed || (found.contains("a/x.pdf") && !found.contains("a/x-2.svg"))));
  }
  CHECK(left > 50);
}
#endif

TEST_CASE("the next run removes what killed ones left, and nothing else", "[killed]") {
  const TemporaryFolder folder(memory());
  leave_part(folder.path());
  const std::set<std::string> parts = folder.names();
  const std::string left = *parts.begin();
  write_bytes(folder / ".ridgecraft-notes.part", "mine");
  write_bytes(folder / ".x.part", "mine");
  fs::create_directory(folder / ("x" + left));
  fs::create_symlink(".x.part", folder / ".ridgecraft-0123456789abcdef-0.part");
  PendingFiles alive;
  alive.add(folder / "x.svg", "new svg");
  CHECK(std::none_of(parts.begin(), parts.end(),
                     [&](const std::string& part) { return fs::exists(folder / part); }));
  write_set(folder.path(), {{"next", "1"}});
  alive.commit();
  CHECK(folder.names() == std::set<std::string>{".ridgecraft-notes.part", ".x.part", "x" + left,
                                                ".ridgecraft-0123456789abcdef-0.part", "x.svg", "next"});
}

TEST_CASE("what a killed run of another user left stays", "[killed]") {
  if (::geteuid() != 0 || !can_drop_rights()) {
    WARN("skipped: only root can be several users");
    return;
  }
  const TemporaryFolder folder;
  fs::permissions(folder.path(), fs::perms::all);
  write_bytes(folder / "house.obj", house);
  leave_part(folder.path());
  RunOptions options = in(folder);
  options.as_nobody = true;
  CHECK(run_program({"segment", "house.obj", "--labels", "labels"}, options).exit_code == 0);
  CHECK(parts_in(folder.path()) == 2);
  CHECK(run_program({"segment", "house.obj", "--labels", "others"}, in(folder)).exit_code == 0);
  CHECK(parts_in(folder.path()) == 0);
}

TEST_CASE("the program killed at 20 moments", "[killed][slow]") {
  const TemporaryFolder folder;
  write_bytes(folder / "house.obj", house);
  const std::vector<std::string> small{"house.obj", "--size", "8cm"};
  const std::vector<std::string> large{"house.obj", "--size", "25cm"};
  std::vector<Contents> sets;
  double seconds = 0.0;
  for (const auto& arguments : {small, large}) {
    const Outcome outcome = run_program(arguments, in(folder));
    REQUIRE(outcome.exit_code == 0);
    seconds = outcome.seconds;
    sets.push_back(contents(folder.path()));
  }
  Random random(1);
  int killed = 0;
  int while_writing_killed = 0;
  for (int i = 0; i < 20; ++i) {
    CAPTURE(i);
    REQUIRE(run_program(small, in(folder)).exit_code == 0);
    // In turn: any moment of the run; soon after its first file.
    const bool while_writing = i % 2 == 1;
    const std::chrono::duration<double> wait(random.unit() * (while_writing ? 0.005 : seconds));
    std::optional<std::chrono::steady_clock::time_point> start;
    RunOptions options = in(folder);
    options.kill_when = [&] {
      const auto now = std::chrono::steady_clock::now();
      if (!start && (!while_writing || parts_in(folder.path()) > 0)) {
        start = now;
      }
      return start && now - *start >= wait;
    };
    killed += run_program(large, options).by_signal ? 1 : 0;
    while_writing_killed += while_writing && parts_in(folder.path()) > 0 ? 1 : 0;
    const Outcome next = run_program({"segment", "house.obj", "--labels", "labels"}, in(folder));
    INFO(next.err);
    CHECK(next.exit_code == 0);
    fs::remove(folder / "labels");
    for (const auto& [name, bytes] : contents(folder.path())) {
      CAPTURE(name);
      CHECK(((sets[0].contains(name) && sets[0][name] == bytes) ||
             (sets[1].contains(name) && sets[1][name] == bytes)));
    }
  }
  CHECK(killed > 5);
  CHECK(while_writing_killed > 0);
}
