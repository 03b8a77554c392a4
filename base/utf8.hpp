// SPDX-License-Identifier: GPL-3.0-or-later
// UTF-8 of unknown origin, one character at a time (RFC 3629).
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace ridgecraft {

/// Stands for what isn't UTF-8.
inline constexpr char32_t replacement_character = 0xFFFD;

struct Utf8Character {
  char32_t code;
  std::size_t length;  ///< bytes
};

/// The first character of a text that isn't empty. A byte that begins no valid sequence (cut off, overlong, a
/// surrogate, beyond U+10FFFF) is a replacement character of length 1.
[[nodiscard]] Utf8Character first_character(std::string_view utf8);

/// Control characters (C0, DEL, C1) and the two Unicode line separators: they would break a line or drive a
/// terminal.
[[nodiscard]] constexpr bool is_control(char32_t code) {
  return code < 0x20 || (code >= 0x7F && code < 0xA0) || code == 0x2028 || code == 0x2029;
}

/// One code point as UTF-8.
void append_utf8(std::string& out, char32_t code);

/// The code points of a text as every file format may hold it. Bytes that aren't UTF-8 become U+FFFD; control
/// characters and the few code points that XML forbids become spaces, so that a model's name can't break a
/// file.
[[nodiscard]] std::vector<char32_t> code_points(std::string_view utf8);
/// The text with what code_points() replaces replaced: valid UTF-8 without control characters.
[[nodiscard]] std::string printable_utf8(std::string_view utf8);

}  // namespace ridgecraft
