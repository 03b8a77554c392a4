// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/check_nets.hpp"

#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <catch2/catch.hpp>
#include <sys/wait.h>
#include <unistd.h>

namespace ridgecraft::test {

CheckNets check_nets(std::string_view fold) {
  namespace fs = std::filesystem;
  const fs::path checker = fs::path(RIDGECRAFT_SHARED_DIR) / "check" / "check_nets.py";
  const fs::path python = "/usr/bin/python3";
  CheckNets result;
  if (!fs::exists(checker) || !fs::exists(python)) {
    WARN("skipped: " << (fs::exists(python) ? checker : python) << " is missing");
    return result;
  }
  // Tests run side by side, each in a process of its own.
  static std::atomic<int> number{0};
  const fs::path file = fs::temp_directory_path() / ("ridgecraft-check-" + std::to_string(getpid()) + "-" +
                                                     std::to_string(number++) + ".fold");
  fs::path answer = file;
  answer += ".json";
  std::ofstream(file, std::ios::binary) << fold;
  const std::string command = python.string() + " '" + checker.string() + "' --json '" + file.string() +
                              "' > '" + answer.string() + "' 2>&1";
  const int status = std::system(command.c_str());
  std::ifstream in(answer, std::ios::binary);
  result.output.assign(std::istreambuf_iterator<char>(in), {});
  result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  result.ran = true;
  fs::remove(file);
  fs::remove(answer);
  return result;
}

}  // namespace ridgecraft::test
