// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/printable.hpp"

#include "base/utf8.hpp"

namespace ridgecraft {
namespace {

/// Words of a file are cut here, so that a message stays one line on a screen.
constexpr std::size_t longest_quotation = 40;

}  // namespace

std::string printable(std::string_view text) {
  std::string result;
  result.reserve(text.size());
  while (!text.empty()) {
    const auto [code, length] = first_character(text);
    append_utf8(result, is_control(code) ? replacement_character : code);
    text.remove_prefix(length);
  }
  return result;
}

std::string shortened(std::string_view text) {
  std::size_t length = text.size();
  if (length > longest_quotation) {
    length = longest_quotation;
    while (length > 0 && (static_cast<unsigned char>(text[length]) & 0xc0U) == 0x80U) {
      --length;  // not in the middle of a character
    }
  }
  return printable(text.substr(0, length)) + (length < text.size() ? "..." : "");
}

std::string in_quotes(std::string_view text) {
  return '"' + shortened(text) + '"';
}

}  // namespace ridgecraft
