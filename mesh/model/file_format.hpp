// SPDX-License-Identifier: GPL-3.0-or-later
// The formats of model files, in one table.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace ridgecraft::mesh {

enum class FileFormat { obj, stl_ascii, stl_binary, ply_ascii, ply_binary, off };

/// "OBJ", "STL", "PLY" or "OFF".
[[nodiscard]] std::string_view format_name(FileFormat format);

/// "OBJ", "STL", "PLY", "OFF": each name once. They are the suffixes of their files, too.
[[nodiscard]] std::vector<std::string> format_names();

/// The number that the format itself gives to the first point of a file: OBJ counts from 1, others from 0.
[[nodiscard]] std::uint32_t first_point_number(FileFormat format);

}  // namespace ridgecraft::mesh
