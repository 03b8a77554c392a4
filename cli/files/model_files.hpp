// SPDX-License-Identifier: GPL-3.0-or-later
// What belongs to a model's file and lies next to it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace ridgecraft::cli {

/// The materials and pictures of a model: files next to it whose names are in it, or in such a file.
[[nodiscard]] std::vector<std::filesystem::path> files_of_model(const std::filesystem::path& model,
                                                                const std::string& bytes);

}  // namespace ridgecraft::cli
