// SPDX-License-Identifier: GPL-3.0-or-later
// From a file to what it says: reads each format of format_names() into a Soup, whatever the file is called.
#pragma once

#include <filesystem>
#include <string_view>

#include "base/context.hpp"
#include "mesh/model/soup.hpp"

namespace ridgecraft::mesh {

/// Reads a mesh file with its material files. The content decides on the format; the suffix helps only where
/// the content could be several. Time and memory are linear in the size of the file; counts in headers are
/// compared with the bytes that are there. The result has at least one polygon and finite points. Throws
/// Error(unreadable_input) or Error(unusable_mesh) with one sentence that names the file, the place in it and
/// the reason. `importer` is the program that reads formats by Assimp (ReadOptions::importer); without it
/// they are refused.
[[nodiscard]] Soup read_soup(const std::filesystem::path& file, const Context& context,
                             const std::filesystem::path& importer = {});

/// The same for bytes in memory. `file_name` is used for messages and for its suffix. Material files and
/// pictures are looked for in `folder_for_materials`; where that is empty none are opened and materials are
/// names only.
[[nodiscard]] Soup parse_soup(std::string_view bytes, std::string_view file_name,
                              const std::filesystem::path& folder_for_materials, const Context& context,
                              const std::filesystem::path& importer = {});

}  // namespace ridgecraft::mesh
