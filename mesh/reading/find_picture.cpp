// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/reading/find_picture.hpp"

#include <fmt/format.h>

#include "base/printable.hpp"
#include "mesh/reading/check_picture.hpp"
#include "mesh/reading/find_beside.hpp"
#include "mesh/reading/read_file.hpp"

namespace ridgecraft::mesh {

std::string PictureFinder::find(const std::filesystem::path& folder, std::string_view name) {
  auto file = find_beside(folder, name);
  if (!file) {
    file = find_beside(source_.folder, name);
  }
  const auto [entry, fresh] = found_.try_emplace(file ? file->string() : std::string(name));
  if (!fresh) {
    return entry->second;
  }
  const std::string what = file ? fault(*file) : "was not found";
  if (!what.empty()) {
    remarks_.add(RepairKind::texture_missing, 1, fmt::format("{} {}", in_quotes(name), what));
    return {};
  }
  entry->second = file->lexically_relative(source_.folder).string();
  if (entry->second.empty()) {  // one path is absolute, the other isn't
    entry->second = std::filesystem::absolute(*file).string();
  }
  return entry->second;
}

std::string PictureFinder::fault(const std::filesystem::path& file) const {
  source_.context.check();
  try {
    return picture_fault(read_file(file));
  } catch (const Error&) {
    return "can't be read";
  }
}

}  // namespace ridgecraft::mesh
