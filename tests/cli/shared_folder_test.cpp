// SPDX-License-Identifier: GPL-3.0-or-later
// Several runs that write into one folder at the same time: whose files stand there in the end.
#include <barrier>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include <catch2/catch.hpp>
#include <unistd.h>

#include "base/error.hpp"
#include "cli/files/set/folder_lock.hpp"
#include "cli/files/set/pending_files.hpp"
#include "cli/program_checks.hpp"
#include "support/temporary_folder.hpp"

using namespace ridgecraft;
using namespace ridgecraft::test;
using cli::PendingFiles;
namespace fs = std::filesystem;
using namespace std::chrono_literals;

namespace {

/// Runs the program as process 1 of a container; empty where that isn't permitted.
std::vector<std::string> container() {
  std::vector<std::string> command{"unshare", "--pid", "--fork"};
  if (::geteuid() != 0) {
    command.insert(command.begin() + 1, {"--user", "--map-root-user"});
  }
  std::vector<std::string> trial = command;
  trial.emplace_back("true");
  return run_command(trial).exit_code == 0 ? command : std::vector<std::string>{};
}

Outcome run_in(std::vector<std::string> container, const std::vector<std::string>& arguments,
               const TemporaryFolder& folder) {
  container.emplace_back(RIDGECRAFT_PROGRAM);
  container.insert(container.end(), arguments.begin(), arguments.end());
  return run_command(container, in(folder));
}

/// Both at once, `repeats` times, into a folder that isn't there before. Counts what is neither's set.
void run_pairs(const std::vector<std::string>& first, const std::vector<std::string>& second, int repeats) {
  const std::vector<std::string> command = container();
  if (command.empty()) {
    WARN("skipped: no containers here");
    return;
  }
  const TemporaryFolder folder;
  write_bytes(folder / "house.obj", house);
  std::vector<Contents> wanted;
  for (const auto& arguments : {first, second}) {
    REQUIRE(run_in(command, arguments, folder).exit_code == 0);
    wanted.push_back(contents(folder / "out"));
    fs::remove_all(folder / "out");
  }
  REQUIRE(wanted[0] != wanted[1]);
  for (int i = 0; i < repeats; ++i) {
    Outcome a;
    {
      const std::jthread other([&] { a = run_in(command, first, folder); });
      const Outcome b = run_in(command, second, folder);
      INFO(b.err);
      CHECK(b.exit_code == 0);
    }
    INFO(a.err);
    CHECK(a.exit_code == 0);
    const Contents now = contents(folder / "out");
    CHECK((now == wanted[0] || now == wanted[1]));
    fs::remove_all(folder / "out");
  }
}

const std::vector<std::string> small{"house.obj", "-o", "out", "--size", "8cm"};
const std::vector<std::string> smaller{"house.obj", "-o", "out", "--size", "79mm"};
const std::vector<std::string> large{"house.obj", "-o", "out", "--size", "16cm"};

}  // namespace

TEST_CASE("two containers that write into one folder leave the set of one", "[shared]") {
  run_pairs(small, smaller, 3);
  run_pairs(small, large, 3);  // with another number of pages
}

TEST_CASE("two containers that write into one folder, 40 times", "[shared][slow]") {
  run_pairs(small, smaller, 40);
  run_pairs(small, large, 40);
}

TEST_CASE("two sets of one process that race for one folder don't mix", "[shared]") {
  constexpr int rounds = 100;
  const TemporaryFolder folder(memory());
  std::size_t mixed = 0;
  std::barrier both(2, [&]() noexcept {
    const Contents now = contents(folder.path());
    const bool one = now == Contents{{"x.pdf", "1"}, {"x.svg", "1"}, {"x.fold", "1"}};
    const bool two = now == Contents{{"x.pdf", "2"}, {"x-1.svg", "2"}, {"x-2.svg", "2"}, {"x.fold", "2"}};
    mixed += one || two || now.empty() ? 0U : 1U;
  });
  const auto write = [&](const std::string& mark, const std::vector<std::string>& names,
                         const std::vector<std::string>& of_the_other) {
    for (int i = 0; i < rounds; ++i) {
      both.arrive_and_wait();
      PendingFiles pending;
      for (const std::string& name : names) {
        pending.add(folder / name, mark);
      }
      pending.commit([&] {
        std::vector<fs::path> found;
        for (const std::string& name : of_the_other) {
          if (fs::exists(folder / name)) {
            found.push_back(folder / name);
          }
        }
        return found;
      });
    }
    both.arrive_and_wait();
  };
  {
    const std::jthread first([&] { write("1", {"x.pdf", "x.svg", "x.fold"}, {"x-1.svg", "x-2.svg"}); });
    const std::jthread second([&] { write("2", {"x.pdf", "x-1.svg", "x-2.svg", "x.fold"}, {"x.svg"}); });
  }
  CHECK(mixed == 0);
}

TEST_CASE("two sets in the same folders, named in another order, don't wait for each other", "[shared]") {
  const TemporaryFolder folder(memory());
  const auto write = [&](const char* first, const char* second) {
    for (int i = 0; i < 50; ++i) {
      PendingFiles pending;
      pending.add(folder / first, first);
      pending.add(folder / second, first);
      pending.commit();
    }
  };
  {
    const std::jthread one([&] { write("a/x", "b/x"); });
    const std::jthread other([&] { write("b/x", "a/x"); });
  }
  CHECK(read_bytes(folder / "a/x") == read_bytes(folder / "b/x"));
  CHECK(fs::exists(folder / "a/x"));
}

TEST_CASE("two sets that make the same folder, of which one is given up", "[shared]") {
  const TemporaryFolder folder(memory());
  std::barrier both(2, [&]() noexcept { fs::remove_all(folder / "a"); });
  std::size_t failed = 0;
  const std::jthread other([&] {
    for (int i = 0; i < 1000; ++i) {
      both.arrive_and_wait();
      PendingFiles given_up;
      given_up.add(folder / "a/b/y", "y");
    }
  });
  for (int i = 0; i < 1000; ++i) {
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

TEST_CASE("a folder that another run removes before there is anything in it is made again", "[shared]") {
  const TemporaryFolder folder;
  const auto write = [&](const std::string& step, int number) {
    PendingFiles pending({.before_step = [&](std::string_view now) {
      if (now == step && --number == 0) {
        fs::remove(folder / "a/b");
        fs::remove(folder / "a");
      }
    }});
    pending.add(folder / "a/b/x", "x");
    pending.commit();
    CHECK(number <= 0);
    CHECK(contents(folder / "a") == Contents{{"b/x", "x"}});
    fs::remove_all(folder / "a");
  };
  write("open", 1);
  write("mkdir", 2);
}

TEST_CASE("a file that another run has put there meanwhile isn't replaced unasked", "[shared][slow]") {
  const TemporaryFolder folder;
  for (const char* name : {"one", "two"}) {
    fs::create_directory(folder / name);
  }
  write_bytes(folder / "one/house.obj", house);
  write_bytes(folder / "two/house.obj", std::string(house) + "# another model by one word\nv 9 9 9\n");
  for (int i = 0; i < 5; ++i) {
    Outcome a;
    Outcome b;
    {
      const std::jthread other([&] { a = run_program({"one/house.obj", "-o", "out"}, in(folder)); });
      b = run_program({"two/house.obj", "-o", "out"}, in(folder));
    }
    INFO(a.err << b.err);
    CHECK(std::set<int>{a.exit_code, b.exit_code} == std::set<int>{0, 7});
    CHECK(fs::exists(folder / "out/house.pdf"));
    fs::remove_all(folder / "out");
  }
}

TEST_CASE("while another run holds a folder, a set waits, can be discarded, and ends with a sentence",
          "[shared]") {
  const TemporaryFolder folder;
  auto other = cli::Folder::open(folder.path(), {});
  REQUIRE(other);
  PendingFiles pending({.longest_wait = 50ms});
  pending.add(folder / "x.pdf", "1");
  {
    const auto held = cli::FolderLock::take(*other, {1ms});
    REQUIRE(held);
    CHECK_FALSE(cli::FolderLock::take(*other, {1ms}));
    CHECK_THROWS_WITH(pending.commit(), Catch::Contains("another run has been putting files there"));
    PendingFiles patient;
    CHECK_FALSE(fs::exists(folder / "x.pdf"));
    const std::jthread interruption([&] {
      std::this_thread::sleep_for(50ms);
      patient.discard();
    });
    try {
      patient.add(folder / "y.pdf", "1");
      FAIL("added without the lock");
    } catch (const Error& error) {
      CHECK(error.kind() == ErrorKind::interrupted);
    }
  }
  pending.commit();
  CHECK(folder.names() == std::set<std::string>{"x.pdf"});
}
