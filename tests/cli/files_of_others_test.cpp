// SPDX-License-Identifier: GPL-3.0-or-later
// Hidden files that a run leaves alone: those of living runs, of others, and of runs that nobody can tell of.
#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <set>
#include <string>
#include <string_view>

#include <catch2/catch.hpp>
#include <unistd.h>
#ifdef __linux__
#include <cerrno>
#include <cstddef>
#include <iterator>

#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#endif

#include "cli/files/set/pending_files.hpp"
#include "cli/files/set/temporary_names.hpp"
#include "cli/killed_runs_checks.hpp"
#include "support/temporary_folder.hpp"

using namespace ridgecraft;
using namespace ridgecraft::test;
using cli::PendingFiles;
namespace fs = std::filesystem;

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
