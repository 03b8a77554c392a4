// SPDX-License-Identifier: GPL-3.0-or-later
// A folder of its own for a test, removed at its end.
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <string_view>

namespace ridgecraft::test {

class TemporaryFolder {
 public:
  TemporaryFolder();
  /// Inside this one.
  explicit TemporaryFolder(const std::filesystem::path& parent);
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

/// The bytes of all files below a folder, hidden files included, by their paths from there.
using Contents = std::map<std::string, std::string>;
[[nodiscard]] Contents contents(const std::filesystem::path& folder);

/// A folder for temporary ones that is no disk, so that nobody waits for it; one like any other where there
/// is none.
[[nodiscard]] std::filesystem::path memory();

[[nodiscard]] std::string read_bytes(const std::filesystem::path& file);
void write_bytes(const std::filesystem::path& file, std::string_view bytes);

}  // namespace ridgecraft::test
