// SPDX-License-Identifier: GPL-3.0-or-later
// The words of a PDF content stream (ISO 32000-1, section 7.2).
#pragma once

#include <string_view>
#include <vector>

namespace ridgecraft::verify {

struct ContentToken {
  enum class Kind { end, number, name, word, open_list, close_list, other };
  Kind kind = Kind::end;
  double number = 0.0;
  std::string_view text;  ///< of a name without its slash, or of a word
};

/// Takes the next token off the bytes. Texts and dictionaries are `other`: what is in them draws nothing.
/// Throws NotInForm where one isn't closed. O(size of the token).
[[nodiscard]] ContentToken take_token(std::string_view& bytes);

}  // namespace ridgecraft::verify
