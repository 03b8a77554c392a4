// SPDX-License-Identifier: GPL-3.0-or-later
// The bytes of a file, whatever is in it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace ridgecraft::mesh {

/// Larger files are refused before they are read (4 GiB): no paper model is near it.
inline constexpr std::uint64_t largest_file_size = std::uint64_t{1} << 32U;

/// All bytes of a regular file. Folders, pipes and devices are refused, so it never waits for input. Throws
/// Error(unreadable_input).
[[nodiscard]] std::string read_file(const std::filesystem::path& file);

}  // namespace ridgecraft::mesh
