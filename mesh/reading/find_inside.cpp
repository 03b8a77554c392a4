// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/reading/find_inside.hpp"

#include <algorithm>
#include <system_error>

#include "mesh/reading/encoded_text.hpp"

namespace ridgecraft::mesh {
namespace {

namespace fs = std::filesystem;

/// "https", "file" and the like before a colon; drives of Windows, too.
bool has_scheme(std::string_view address) {
  const std::size_t colon = address.find(':');
  return colon != address.npos && colon > 0 && address.find_first_of("/\\%?#") > colon;
}

bool leads_out(const fs::path& relative) {
  const fs::path plain = relative.lexically_normal();
  return relative.is_absolute() || plain.empty() || *plain.begin() == "..";
}

}  // namespace

bool lies_inside(const fs::path& folder, const fs::path& file) {
  std::error_code error;
  const fs::path home = fs::canonical(folder, error);
  const fs::path real = error ? fs::path() : fs::canonical(file, error);
  return !error && std::mismatch(home.begin(), home.end(), real.begin(), real.end()).first == home.end();
}

FoundInside find_inside(const fs::path& folder, std::string_view address) {
  // Longer names than any file system has, and names with a zero byte, would only confuse it.
  constexpr std::size_t longest = 4096;
  if (has_scheme(address)) {
    return {{}, "lies elsewhere: nothing is fetched, put the file beside the model and name it there"};
  }
  if (folder.empty()) {
    return {{}, "can't be found: nothing lies beside standard input"};
  }
  const std::string resolved = from_percent(address);
  std::string slashes = resolved;
  std::replace(slashes.begin(), slashes.end(), '\\', '/');
  bool outside = false;
  for (const std::string& name : {std::string(address), resolved, slashes}) {
    if (name.empty() || name.size() > longest || name.find('\0') != name.npos) {
      continue;
    }
    std::error_code error;
    const fs::path file = folder / name;
    if (leads_out(name)) {
      outside = true;
    } else if (fs::is_regular_file(file, error)) {
      if (lies_inside(folder, file)) {
        return {file, {}};
      }
      outside = true;
    }
  }
  return {
      {},
      outside ? "lies outside the model's folder, where nothing is read" : "was not found beside the model"};
}

}  // namespace ridgecraft::mesh
