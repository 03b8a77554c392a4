// SPDX-License-Identifier: GPL-3.0-or-later
// Which format some bytes are, whatever the file is called; and what a file that no reader knows is instead.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "base/encodings.hpp"
#include "mesh/model/soup.hpp"
#include "mesh/reading/source.hpp"

namespace ridgecraft::mesh {

// Sizes of a binary STL file: 80 bytes of anything, a count, then facets of a normal, three corners and two
// bytes.

inline constexpr std::size_t stl_count_at = 80;
inline constexpr std::size_t stl_header_size = 84;
inline constexpr std::size_t stl_facet_size = 50;

/// The count in the header of at least stl_header_size bytes.
[[nodiscard]] constexpr std::uint32_t stl_facet_count(std::string_view bytes) {
  return static_cast<std::uint32_t>(little_endian(bytes.substr(stl_count_at, 4)));
}

[[nodiscard]] constexpr std::uint64_t stl_file_size(std::uint64_t facets) {
  return stl_header_size + stl_facet_size * facets;
}

// What a file that is no mesh of ours is instead, and how to get one that is.

/// As "is no mesh but a PNG picture", or "is a STEP model, which isn't read: open it in ..."; of formats
/// that Assimp reads, that what reads them is missing; nothing where that can't be seen. The suffix helps
/// with what many formats are packed in.
[[nodiscard]] std::optional<std::string> foreign_content(std::string_view bytes, std::string_view suffix);

/// The same by the suffix alone (without its dot), for content that decides nothing.
[[nodiscard]] std::optional<std::string> foreign_suffix(std::string_view suffix);

/// The format that such content is in, of those that Assimp reads; nothing for all other content. The suffix
/// helps in the same way.
[[nodiscard]] std::optional<FileFormat> imported_format(std::string_view bytes, std::string_view suffix);
[[nodiscard]] std::optional<FileFormat> imported_format(std::string_view suffix);

/// What somebody can do with a file of such a format that can't be read.
[[nodiscard]] std::string_view way_by_blender();

/// The format of the content; the suffix of the name decides only where the content could be several. PLY
/// files are distinguished as far as ASCII and binary. Throws Error(unreadable_input) that says what the file
/// is instead, where that can be seen. Reads a few lines at the start, and comments before them.
[[nodiscard]] FileFormat detect_format(const Source& source, std::string_view file_name);

/// "OFF", with the prefixes of the format's description (Geomview): [ST][C][N][4][n]OFF.
[[nodiscard]] bool is_off_keyword(std::string_view word);

/// True where the suffix of a file name is that of a mesh format other than this one.
[[nodiscard]] bool suffix_contradicts(std::string_view file_name, FileFormat format);

}  // namespace ridgecraft::mesh
