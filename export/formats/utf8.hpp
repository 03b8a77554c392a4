// SPDX-License-Identifier: GPL-3.0-or-later
// Text as every file format may hold it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "mesh/foundation/utf8.hpp"

namespace ridgecraft::paper {

/// The code points of a text. Bytes that aren't UTF-8 become U+FFFD; control characters and the few code
/// points that XML forbids become spaces, so that a model's name can't break a file.
[[nodiscard]] std::vector<char32_t> code_points(std::string_view utf8);

/// The text with what code_points() replaces replaced: valid UTF-8 without control characters.
[[nodiscard]] std::string printable_utf8(std::string_view utf8);

}  // namespace ridgecraft::paper
