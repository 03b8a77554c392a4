// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/benchmark_models.hpp"

#include <charconv>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include <catch2/catch.hpp>

namespace ridgecraft::test {

bool unpack_benchmark(const std::vector<std::string>& members, const std::filesystem::path& folder) {
  const auto archive = std::filesystem::path(RIDGECRAFT_SHARED_DIR) / "models" / "psb.tar.xz";
  if (!std::filesystem::exists(archive)) {
    WARN("skipped: no benchmark models at " << archive.string());
    return false;
  }
  std::string command = "tar xJf '" + archive.string() + "' -C '" + folder.string() + "'";
  for (const std::string& member : members) {
    command += " '" + member + "'";
  }
  REQUIRE(std::system(command.c_str()) == 0);
  return true;
}

std::vector<std::uint32_t> read_labels(const std::filesystem::path& file) {
  // Two thousand files of 20 000 numbers are read: >> would take most of the tests' time.
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  const std::string read = std::move(text).str();
  std::vector<std::uint32_t> labels;
  const char* at = read.data();
  const char* const end = at + read.size();
  while (at != end) {
    std::uint32_t label = 0;
    const auto [next, error] = std::from_chars(at, end, label);
    if (error == std::errc()) {
      labels.push_back(label);
      at = next;
    } else {
      ++at;
    }
  }
  return labels;
}

}  // namespace ridgecraft::test
