// SPDX-License-Identifier: GPL-3.0-or-later
// Text: UTF-8 of unknown origin, what is fit for a message, parts of sentences, lengths as people type them.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace ridgecraft {

// UTF-8 of unknown origin, one character at a time (RFC 3629).

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

// Text of unknown origin (file names, words of a file) made fit for a message of one line.

/// The text as valid UTF-8 without control characters: each byte that is not part of a valid sequence and
/// each control character becomes U+FFFD.
[[nodiscard]] std::string printable(std::string_view text);

/// The same, cut after about 40 characters.
[[nodiscard]] std::string shortened(std::string_view text);

/// The same, in quotation marks.
[[nodiscard]] std::string in_quotes(std::string_view text);

// Parts of sentences.

/// "1 part", "3 parts"
[[nodiscard]] std::string counted(std::size_t count, const std::string& word);

/// "a", "a and b", "a, b and c"; `conjunction` is "and" or "or".
[[nodiscard]] std::string listed(const std::vector<std::string>& words, const std::string& conjunction);

// "Did you mean ...?": the known word that is nearest to a mistyped one.

/// The word of `known` with the smallest edit distance (insertions, deletions, replacements; letters compared
/// without regard to case), the first of equals; empty when even that is further off than a third of the
/// word's length, plus 1.
[[nodiscard]] std::string nearest_word(std::string_view word, std::span<const std::string> known);

// A text by its ends.

/// The text from `first` up to `last`. std::string_view takes two pointers since C++20, but not in every
/// library that the program is built with (wasm/).
[[nodiscard]] constexpr std::string_view text_between(const char* first, const char* last) {
  return {first, static_cast<std::size_t>(last - first)};
}

// Lengths as people type them: "150mm", "6 in", "8.5".

struct LengthText {
  double number = 0.0;                ///< as typed; finite or not, of either sign
  std::optional<double> mm_per_unit;  ///< none where no unit stands behind the number
};

/// Millimetres in one mm, cm, m, in (inch, inches, "), ft; nothing for another word.
[[nodiscard]] std::optional<double> unit_mm(std::string_view word);

/// Takes a number and the unit behind it off the front of `text`, and blanks around them. Nothing where no
/// number that a double holds stands there.
[[nodiscard]] std::optional<LengthText> take_length(std::string_view& text);

/// Without blanks and tabs at both ends.
[[nodiscard]] std::string_view trimmed(std::string_view text);

}  // namespace ridgecraft
