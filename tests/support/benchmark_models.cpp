// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/benchmark_models.hpp"

#include <cstdlib>
#include <fstream>

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
  std::ifstream in(file);
  std::vector<std::uint32_t> labels;
  std::uint32_t label = 0;
  while (in >> label) {
    labels.push_back(label);
  }
  return labels;
}

}  // namespace ridgecraft::test
