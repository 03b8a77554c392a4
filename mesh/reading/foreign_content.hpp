// SPDX-License-Identifier: GPL-3.0-or-later
// What a file that is no mesh of ours is instead, and how to get one that is.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "mesh/model/file_format.hpp"

namespace ridgecraft::mesh {

/// As "is no mesh but a PNG picture", or "is a STEP model, which isn't read: open it in ..."; of formats
/// that Assimp reads, that what reads them is missing; nothing where that can't be seen. The suffix helps
/// with what many formats are packed in.
[[nodiscard]] std::optional<std::string> foreign_content(std::string_view bytes, std::string_view suffix);

/// The same by the suffix alone (without its dot), for content that tells nothing.
[[nodiscard]] std::optional<std::string> foreign_suffix(std::string_view suffix);

/// The format that such content is in, of those that Assimp reads; nothing for all other content. The suffix
/// helps in the same way.
[[nodiscard]] std::optional<FileFormat> imported_format(std::string_view bytes, std::string_view suffix);
[[nodiscard]] std::optional<FileFormat> imported_format(std::string_view suffix);

/// What somebody can do with a file of such a format that can't be read.
[[nodiscard]] std::string_view way_by_blender();

}  // namespace ridgecraft::mesh
