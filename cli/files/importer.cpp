// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/files/importer.hpp"

#include <array>
#include <system_error>

#include <unistd.h>

namespace ridgecraft::cli {

std::filesystem::path importer_program() {
  std::error_code ignored;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", ignored);
  if (self.empty()) {
    return {};
  }
  const std::filesystem::path folder = self.parent_path();
  for (const std::filesystem::path& program : std::array{
           folder / "ridgecraft-import", folder.parent_path() / "libexec/ridgecraft/ridgecraft-import"}) {
    if (::access(program.c_str(), X_OK) == 0) {
      return program;
    }
  }
  return {};
}

}  // namespace ridgecraft::cli
