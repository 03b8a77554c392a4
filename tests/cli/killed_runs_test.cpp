// SPDX-License-Identifier: GPL-3.0-or-later
// What runs leave behind that are killed at any moment, and what the next one makes of it.
#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <functional>
#include <list>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>
#ifdef __linux__
#include <cstddef>

#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#endif

#include "base/error.hpp"
#include "cli/files/set/pending_files.hpp"
#include "cli/files/set/temporary_names.hpp"
#include "cli/program_checks.hpp"
#include "support/temporary_folder.hpp"

using namespace ridgecraft;
using namespace ridgecraft::test;
using cli::PendingFiles;
namespace fs = std::filesystem;

namespace {

using Notes = std::vector<std::string>;
bool is_hidden(const std::string& file) {
  return fs::path(file).filename().string().starts_with('.');
}

/// Without a lock file that has no words yet: its run may be just about to lock it.
bool is_to_be_told(const fs::path& folder) {
  Contents all = contents(folder);
  std::erase_if(all, [](const auto& file) {
    return !is_hidden(file.first) || (file.first == cli::lock_name && file.second.empty());
  });
  return !all.empty();
}

/// Their number, also while they come and go.
std::size_t hidden_in(const fs::path& folder) {
  std::size_t count = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    count += is_hidden(entry.path().string()) ? 1U : 0U;
  }
  return count;
}

/// Without hidden files, and without the one that only the next run writes.
Contents visible(const fs::path& folder) {
  Contents all = contents(folder);
  std::erase_if(all, [](const auto& file) { return is_hidden(file.first) || file.first.ends_with("next"); });
  return all;
}

/// Kills the process before its step of this number, from 0.
cli::BeforeStep death_at(int step) {
  return [left = std::make_shared<int>(step)](std::string_view) {
    if ((*left)-- == 0) {
      ::raise(SIGKILL);
    }
  };
}

/// Does the work in a process of its own; true when it came to its end.
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

/// In two folders: one file is replaced in each, one is new, one goes.
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

/// What any later run does, into one folder.
Notes write_next(const fs::path& folder, const cli::BeforeStep& before_step = {}) {
  PendingFiles pending({.before_step = before_step});
  pending.add(folder / "next", "next");
  return pending.commit();
}

/// Both sets, as they are when nobody dies.
struct BothSets {
  Contents before;
  Contents after;
  std::vector<std::string> steps;  ///< of writing the new one
};

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

/// Two hidden files of each run, killed before it puts anything in place.
void leave_hidden_files(const fs::path& folder, int runs = 1) {
  REQUIRE_FALSE(in_child([&] {
    std::list<PendingFiles> pending;
    for (int i = 0; i < runs; ++i) {
      pending.emplace_back().add(folder / "x.pdf", "new pdf");
    }
    ::raise(SIGKILL);
  }));
}

}  // namespace

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

TEST_CASE("a run killed while it clears up leaves one whole set all the same", "[killed]") {
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

TEST_CASE("files of a living run, of others and of a run elsewhere stay", "[killed]") {
  const TemporaryFolder folder(memory());
  const auto keeps = [&](const std::string& name) {
    write_bytes(folder / name, "not yours");
    write_next(folder.path());
    return fs::exists(folder / name) && read_bytes(folder / name) == "not yours";
  };
  SECTION("a living run") {
    PendingFiles alive;
    alive.add(folder / "x.pdf", "new pdf");
    const auto before = folder.names();
    CHECK(write_next(folder.path()).empty());
    for (const std::string& name : before) {
      CHECK(fs::exists(folder / name));
    }
    alive.commit();
    CHECK(folder.names() == std::set<std::string>{"x.pdf", "next"});
  }
  SECTION("names that aren't ours") {
    CHECK(keeps(".ridgecraft-notes.part"));
    CHECK(keeps(".ridgecraft-17-0.part"));
    CHECK(keeps(".ridgecraft-17-0.old"));
    CHECK(keeps(".ridgecraft.lock"));
  }
  SECTION("a journal that isn't in our words") {
    CHECK(keeps(cli::journal_name(cli::new_run_id(cli::this_kernel()))) ==
          false);  // cut off in its first line
    const std::string name = cli::journal_name(cli::new_run_id(cli::this_kernel()));
    write_bytes(folder / name, "ridgecraft journal 2\nend\n");
    CHECK(write_next(folder.path()).empty());
    CHECK(fs::exists(folder / name));
  }
  SECTION("another machine, unless it has rested for long") {
    for (const std::string_view kernel : {cli::unknown_kernel, std::string_view("12345678")}) {
      const cli::RunId run = cli::new_run_id(kernel);
      write_bytes(folder / cli::journal_name(run), "");
      write_bytes(folder / cli::part_name(run, 0), "half");
      CHECK(write_next(folder.path()).empty());
      CHECK(fs::exists(folder / cli::part_name(run, 0)));
      fs::last_write_time(folder / cli::journal_name(run),
                          fs::file_time_type::clock::now() - std::chrono::minutes(61));
      CHECK(write_next(folder.path()).size() == 1);
      CHECK(folder.names() == std::set<std::string>{"next"});
    }
  }
  SECTION("another user") {
    if (::geteuid() != 0) {
      WARN("skipped: only root can give files away");
      return;
    }
    leave_hidden_files(folder.path());
    const auto before = folder.names();
    for (const std::string& name : before) {
      REQUIRE(::chown((folder / name).c_str(), 65534, 65534) == 0);
    }
    CHECK(write_next(folder.path()).empty());
    for (const std::string& name : before) {
      CHECK(fs::exists(folder / name));
    }
  }
}

#ifdef __linux__
namespace {

/// From now on this process finds no file system that knows locks.
void forbid_locks() {
  const sock_filter forbid[] = {
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, __NR_flock, 0, 1),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | ENOLCK),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW),
  };
  sock_filter filter[4];
  std::copy(std::begin(forbid), std::end(forbid), filter);
  const sock_fprog program{4, filter};
  if (::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0 ||
      ::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) != 0) {
    ::_exit(77);
  }
}

}  // namespace

TEST_CASE("a lock file of another run stays where there are no locks", "[killed]") {
  const TemporaryFolder folder;
  write_bytes(folder / cli::lock_name, "");
  CHECK(in_child([&] {
    forbid_locks();
    write_next(folder.path());
  }));
  CHECK(folder.names() == std::set<std::string>{"next", std::string(cli::lock_name)});
}

TEST_CASE("a file system without locks", "[killed]") {
  const TemporaryFolder folder;
  CHECK(in_child([&] {
    forbid_locks();
    write_next(folder.path());
  }));
  CHECK(folder.names() == std::set<std::string>{"next"});
  // Nobody can tell whether this one still lives.
  CHECK_FALSE(in_child([&] {
    forbid_locks();
    write_next(folder.path(), [](std::string_view step) {
      if (step == "rename") {
        ::raise(SIGKILL);
      }
    });
  }));
  const auto left = folder.names();
  CHECK(left.size() > 1);
  CHECK(in_child([&] {
    forbid_locks();
    write_next(folder.path());
  }));
  CHECK(write_next(folder.path()).empty());
  for (const std::string& name : left) {
    CHECK(fs::exists(folder / name));
    fs::last_write_time(folder / name, fs::file_time_type::clock::now() - std::chrono::hours(2));
  }
  CHECK(write_next(folder.path()).size() == 1);
  CHECK(folder.names() == std::set<std::string>{"next"});
}
#endif

namespace {

/// Kills the program at random moments, half of them while files are being written, and lets another run into
/// the folder follow.
class Killings {
 public:
  Killings() {
    write_bytes(folder_ / "house.obj", house);
    REQUIRE(run_program(small_, in(folder_)).exit_code == 0);
    before_ = results();
    const Outcome outcome = run_program(large_, in(folder_));
    REQUIRE(outcome.exit_code == 0);
    seconds_ = outcome.seconds;
    after_ = results();
    REQUIRE(after_.size() > before_.size());
  }

  void kill_one() {
    REQUIRE(run_program(small_, in(folder_)).exit_code == 0);
    REQUIRE(results() == before_);
    RunOptions options = in(folder_);
    options.kill_when = moment();
    const Outcome killed = run_program(large_, options);
    const std::size_t hidden = hidden_in(folder_.path());
    const bool to_be_told = is_to_be_told(folder_.path());
    const Contents found = results();
    left_something_ += hidden > 0 ? 1U : 0U;
    mixed_ += found != before_ && found != after_ ? 1U : 0U;
    hidden_ += hidden;
    killed_ += killed.by_signal ? 1U : 0U;
    const Outcome next = run_program({"segment", "house.obj", "--labels", "labels.next"}, in(folder_));
    INFO(next.err);
    CHECK(next.exit_code == 0);
    CHECK((next.err.find("killed") != std::string::npos) == to_be_told);
    CHECK(hidden_in(folder_.path()) == 0);
    const Contents now = results();
    CHECK((now == before_ || now == after_));
  }

  /// A run may have come to its end before.
  [[nodiscard]] std::size_t killed() const { return killed_; }
  [[nodiscard]] std::string figures() const {
    return std::to_string(killed_) + " killed, of which " + std::to_string(left_something_) + " left " +
           std::to_string(hidden_) + " hidden files and " + std::to_string(mixed_) +
           " a mixed set, until the next run";
  }

 private:
  [[nodiscard]] Contents results() const {
    Contents all = visible(folder_.path());
    all.erase("house.obj");
    return all;
  }

  /// In turn: any moment of the run; soon after its first hidden file.
  std::function<bool()> moment() {
    using Clock = std::chrono::steady_clock;
    while_writing_ = !while_writing_;
    const double wait_s =
        std::uniform_real_distribution<double>(0.0, while_writing_ ? 0.05 : seconds_)(random_);
    const auto wait = std::chrono::duration<double>(wait_s);
    return
        [this, wait, start = while_writing_ ? std::optional<Clock::time_point>() : Clock::now()]() mutable {
          if (!start && hidden_in(folder_.path()) > 0) {
            start = Clock::now();
          }
          return start && Clock::now() - *start >= wait;
        };
  }

  const std::vector<std::string> small_{"house.obj", "--size", "8cm"};
  const std::vector<std::string> large_{"house.obj", "--size", "25cm"};
  TemporaryFolder folder_;
  Contents before_;
  Contents after_;
  double seconds_ = 0.0;
  bool while_writing_ = false;
  std::mt19937 random_{std::random_device{}()};
  std::size_t killed_ = 0;
  std::size_t left_something_ = 0;
  std::size_t mixed_ = 0;
  std::size_t hidden_ = 0;
};

}  // namespace

TEST_CASE("the program killed at random moments", "[killed]") {
  Killings killings;
  for (int i = 0; i < 8; ++i) {
    killings.kill_one();
  }
}

TEST_CASE("the program killed at 200 random moments", "[killed][slow]") {
  Killings killings;
  while (killings.killed() < 200) {
    killings.kill_one();
  }
  WARN(killings.figures());
}
