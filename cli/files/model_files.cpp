// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/files/model_files.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <system_error>

#include "cli/files/formats.hpp"
#include "mesh/reading/files.hpp"

namespace ridgecraft::cli {

namespace fs = std::filesystem;

std::vector<fs::path> files_of_model(const fs::path& model, const std::string& bytes) {
  constexpr std::array<std::string_view, 8> suffixes{".mtl", ".png", ".jpg", ".jpeg",
                                                     ".tga", ".bmp", ".gif", ".bin"};
  std::vector<fs::path> candidates;
  std::error_code ignored;
  const fs::path folder = model.has_parent_path() ? model.parent_path() : fs::path(".");
  constexpr int deepest = 2;  // textures/wood.png, as far as models are told to look for pictures
  for (fs::recursive_directory_iterator entry(folder, ignored), end; !ignored && entry != end;
       entry.increment(ignored)) {
    if (entry.depth() + 1 >= deepest) {
      entry.disable_recursion_pending();
    }
    if (std::find(suffixes.begin(), suffixes.end(), suffix_of(entry->path())) != suffixes.end() &&
        entry->is_regular_file(ignored) && mesh::lies_inside(folder, entry->path())) {
      candidates.push_back(entry->path());
    }
  }
  std::sort(candidates.begin(), candidates.end());
  std::string texts = bytes;
  std::vector<fs::path> named;
  // Materials first: pictures are named in them.
  for (const bool materials : {true, false}) {
    for (const fs::path& file : candidates) {
      if ((suffix_of(file) == ".mtl") == materials &&
          texts.find(file.filename().string()) != std::string::npos) {
        named.push_back(file);
        if (materials) {
          texts += mesh::read_file(file);
        }
      }
    }
  }
  return named;
}

}  // namespace ridgecraft::cli
