// SPDX-License-Identifier: GPL-3.0-or-later
// Files that a model names: found although names were written on another system.
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

namespace ridgecraft::mesh {

/// The regular file that `name` in a file of `folder` means: tried as it is, with backslashes as slashes, by
/// its last part alone (paths of the computer it was made on), and all that in letters of either case.
/// Nothing where none is there.
[[nodiscard]] std::optional<std::filesystem::path> find_beside(const std::filesystem::path& folder,
                                                               std::string_view name);

}  // namespace ridgecraft::mesh
