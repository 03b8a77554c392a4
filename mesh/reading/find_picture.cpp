// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/reading/find_picture.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "base/printable.hpp"
#include "mesh/reading/check_picture.hpp"
#include "mesh/reading/find_beside.hpp"
#include "mesh/reading/find_inside.hpp"
#include "mesh/reading/read_file.hpp"

namespace ridgecraft::mesh {

std::optional<std::filesystem::path> PictureFinder::file_of(const std::filesystem::path& folder,
                                                            std::string_view name) const {
  std::optional<std::filesystem::path> file = find_beside(folder, name);
  if (!file) {
    file = find_beside(source_.folder, name);
  }
  if (file && !lies_inside(source_.folder, *file)) {
    // Paths are often those of the artist's disk, and a copy lies beside the model.
    std::string slashes(name);
    std::replace(slashes.begin(), slashes.end(), '\\', '/');
    if (auto beside = find_beside(source_.folder, std::filesystem::path(slashes).filename().string())) {
      file = std::move(beside);
    }
  }
  return file;
}

PictureFinder::Found PictureFinder::find(const std::filesystem::path& folder, std::string_view name) {
  const auto file = file_of(folder, name);
  const auto [entry, fresh] = found_.try_emplace(file ? file->string() : std::string(name));
  if (!fresh) {
    return entry->second;
  }
  std::string why = "was not found";
  if (file) {
    why = lies_inside(source_.folder, *file) ? load(*file, entry->second)
                                             : "lies outside the model's folder, where nothing is read";
  }
  if (!why.empty()) {
    remarks_.add(RepairKind::texture_missing, 1, fmt::format("{} {}", in_quotes(name), why));
    return {};
  }
  entry->second.file = file->lexically_relative(source_.folder).string();
  if (entry->second.file.empty()) {  // one path is absolute, the other isn't
    entry->second.file = std::filesystem::absolute(*file).string();
  }
  return entry->second;
}

/// What is wrong with it; nothing where it can be used.
std::string PictureFinder::load(const std::filesystem::path& file, Found& into) const {
  source_.context.check();
  try {
    std::string bytes = read_file(file);
    std::string fault = picture_fault(bytes);
    if (fault.empty()) {
      into.bytes = std::make_shared<const std::string>(std::move(bytes));
    }
    return fault;
  } catch (const Error&) {
    return "can't be read";
  }
}

}  // namespace ridgecraft::mesh
