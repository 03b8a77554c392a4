// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/reading/find_beside.hpp"

#include <algorithm>
#include <string>
#include <system_error>

#include "mesh/reading/text_scanner.hpp"

namespace ridgecraft::mesh {
namespace {

namespace fs = std::filesystem;

bool is_file(const fs::path& path) {
  std::error_code error;
  return fs::is_regular_file(path, error);
}

/// The file of a folder whose name is this but for the case of letters; the first by name where there are
/// several.
std::optional<fs::path> find_in_any_case(const fs::path& wanted) {
  std::optional<fs::path> found;
  std::error_code error;
  const std::string name = wanted.filename().string();
  for (fs::directory_iterator entry(wanted.parent_path(), error), end; !error && entry != end;
       entry.increment(error)) {
    if (equal_ignoring_case(entry->path().filename().string(), name) && is_file(entry->path()) &&
        (!found || entry->path() < *found)) {
      found = entry->path();
    }
  }
  return found;
}

}  // namespace

std::optional<fs::path> find_beside(const fs::path& folder, std::string_view name) {
  // Longer names than any file system has, and names with a zero byte, would only confuse it.
  if (name.empty() || name.size() > 4096 || name.find('\0') != name.npos) {
    return std::nullopt;
  }
  std::string slashes(name);
  std::replace(slashes.begin(), slashes.end(), '\\', '/');
  for (const fs::path& tried : {folder / name, folder / slashes, folder / fs::path(slashes).filename()}) {
    if (is_file(tried)) {
      return tried;
    }
  }
  for (const fs::path& tried : {folder / slashes, folder / fs::path(slashes).filename()}) {
    if (const auto found = find_in_any_case(tried)) {
      return found;
    }
  }
  return std::nullopt;
}

}  // namespace ridgecraft::mesh
