// SPDX-License-Identifier: GPL-3.0-or-later
// A folder of its own for a test, removed at its end.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <string_view>

namespace ridgecraft::test {

class TemporaryFolder {
 public:
  TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder();

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] std::filesystem::path operator/(std::string_view name) const { return path_ / name; }
  /// Names of what lies in it, hidden files included.
  [[nodiscard]] std::set<std::string> names() const;

 private:
  std::filesystem::path path_;
};

[[nodiscard]] std::string read_bytes(const std::filesystem::path& file);
void write_bytes(const std::filesystem::path& file, std::string_view bytes);

}  // namespace ridgecraft::test
