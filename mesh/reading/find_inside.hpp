// SPDX-License-Identifier: GPL-3.0-or-later
// Files that a model needs for its shape: only those that lie in its own folder or below are opened.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace ridgecraft::mesh {

/// What a name in a model leads to: a file, or why there is none ("was not found").
struct FoundInside {
  std::filesystem::path file;  ///< empty where there is none
  std::string why;             ///< a half sentence about the name
};

/// Whether a file that is there lies in the folder or below, links followed.
[[nodiscard]] bool lies_inside(const std::filesystem::path& folder, const std::filesystem::path& file);

/// The regular file in `folder` or below that a relative address means: as it is written, with its percent
/// signs resolved, with backslashes as slashes. Addresses of the network, absolute ones, and those that lead
/// out of the folder (links included) are none.
[[nodiscard]] FoundInside find_inside(const std::filesystem::path& folder, std::string_view address);

}  // namespace ridgecraft::mesh
