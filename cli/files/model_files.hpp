// SPDX-License-Identifier: GPL-3.0-or-later
// What belongs to a model's file and lies next to it.
#pragma once

#include <filesystem>
#include <vector>

namespace ridgecraft::cli {

/// The other files that the model is read from: its materials, pictures and buffers. None where it can't be
/// read. O(file): reads it.
[[nodiscard]] std::vector<std::filesystem::path> files_of_model(const std::filesystem::path& model);

}  // namespace ridgecraft::cli
