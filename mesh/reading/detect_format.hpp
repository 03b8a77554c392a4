// SPDX-License-Identifier: GPL-3.0-or-later
// Which mesh format some bytes are, whatever the file is called.
#pragma once

#include <string_view>

#include "mesh/reading/source.hpp"

namespace ridgecraft::mesh {

/// The format of the content; the suffix of the name decides only where the content could be several. PLY
/// files are told apart as far as ASCII and binary. Throws Error(unreadable_input) that says what the file is
/// instead, where that can be seen. Reads a few lines at the start, and comments before them.
[[nodiscard]] FileFormat detect_format(const Source& source, std::string_view file_name);

/// "OFF", with the prefixes of the format's description (Geomview): [ST][C][N][4][n]OFF.
[[nodiscard]] bool is_off_keyword(std::string_view word);

/// True where the suffix of a file name is that of a mesh format other than this one.
[[nodiscard]] bool suffix_contradicts(std::string_view file_name, FileFormat format);

}  // namespace ridgecraft::mesh
