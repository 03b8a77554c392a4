// SPDX-License-Identifier: GPL-3.0-or-later
// UTF-8 text as code points that every file format may hold.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace ridgecraft::paper {

/// The code points of a text. Bytes that aren't UTF-8 become U+FFFD; control characters and the few code
/// points that XML forbids become spaces, so that a model's name can't break a file.
[[nodiscard]] std::vector<char32_t> code_points(std::string_view utf8);

/// One code point as UTF-8.
void append_utf8(std::string& out, char32_t code);

/// The text with what code_points() replaces replaced: valid UTF-8 without control characters.
[[nodiscard]] std::string printable_utf8(std::string_view utf8);

}  // namespace ridgecraft::paper
