// SPDX-License-Identifier: GPL-3.0-or-later
// Walks through the text of a mesh file word by word over std::from_chars: no allocation, no locale.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "base/text.hpp"

namespace ridgecraft::mesh {

[[nodiscard]] constexpr bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\v' || c == '\f';
}
[[nodiscard]] constexpr bool is_line_end(char c) {
  return c == '\n' || c == '\r';
}
[[nodiscard]] bool equal_ignoring_case(std::string_view a, std::string_view b);

/// What to say behind a word that is no number: some programs write 1,5 in the custom of their user's
/// country.
[[nodiscard]] std::string_view comma_hint(std::string_view word);

/// A place in a text that moves forward.
class TextScanner {
 public:
  /// With `joins_lines` a backslash at the end of a line makes the next line part of it.
  explicit TextScanner(std::string_view text, bool joins_lines = false)
      : at_(text.data()), end_(text.data() + text.size()), joins_lines_(joins_lines) {}

  [[nodiscard]] const char* place() const { return at_; }
  [[nodiscard]] bool done() const { return at_ == end_; }
  [[nodiscard]] std::string_view rest() const { return text_between(at_, end_); }
  /// The next character, 0 at the end.
  [[nodiscard]] char peek() const { return at_ == end_ ? '\0' : *at_; }
  void advance() { ++at_; }

  void skip_blanks() {
    while (at_ != end_ && (is_blank(*at_) || (*at_ == '\\' && joins_lines_ && skip_joint()))) {
      ++at_;
    }
  }
  /// Skips blanks, line ends and, with a mark that isn't 0, comments that begin with it.
  void skip_space(char comment_mark);
  /// Skips blanks; true at the end of the line or where a comment begins.
  [[nodiscard]] bool line_is_over() {
    skip_blanks();
    return at_ == end_ || is_line_end(*at_) || *at_ == '#';
  }
  /// To the start of the next line.
  void next_line();
  /// The same within a comment, where a backslash is a character like others.
  void skip_comment();
  /// The rest of this line without blanks around it; the place is then at the line's end.
  [[nodiscard]] std::string_view rest_of_line();
  /// The characters up to the next blank or line end, after blanks; empty at the end of the line.
  [[nodiscard]] std::string_view word();
  /// The same without moving on.
  [[nodiscard]] std::string_view peek_word() const;

  /// Reads a number after blanks. False, and the place is at the word, where there is none. What is too large
  /// for a double is infinite, what is too small is zero.
  [[nodiscard]] bool number(double& value);
  /// Reads an integer after blanks, closed by anything but a digit. What is beyond 64 bits becomes the
  /// largest.
  [[nodiscard]] bool integer(std::int64_t& value);
  /// True where a word ends here.
  [[nodiscard]] bool at_word_end() const {
    return at_ == end_ || is_blank(*at_) || is_line_end(*at_) || *at_ == '#' || *at_ == '\\';
  }

 private:
  bool skip_joint();

  const char* at_;
  const char* end_;
  bool joins_lines_;
};

// Bytes that are written as text: base64, and the percent signs of addresses.

/// The bytes of a base64 text (RFC 4648), also of its variant for addresses; with or without the equals signs
/// at its end. Nothing where it is no such text.
[[nodiscard]] std::optional<std::string> from_base64(std::string_view text);

/// "%20" becomes a blank and so on; a percent sign without two hexadecimal digits stays as it is.
[[nodiscard]] std::string from_percent(std::string_view text);

}  // namespace ridgecraft::mesh
