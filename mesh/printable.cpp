// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/printable.hpp"

#include <cstdint>

namespace ridgecraft::mesh {
namespace {

/// Words of a file are cut here, so that a message stays one line on a screen.
constexpr std::size_t longest_quotation = 40;

/// Length of the valid UTF-8 sequence at the start of a non-empty text; 0 where there is none.
std::size_t sequence_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned first = byte(0);
  if (first < 0x80) {
    return 1;
  }
  const std::size_t length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  if (first < 0xc2 || first > 0xf4 || text.size() < length) {
    return 0;
  }
  std::uint32_t code = first & (0xffU >> (length + 1));
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0U) != 0x80U) {
      return 0;
    }
    code = code << 6U | (byte(i) & 0x3fU);
  }
  constexpr std::uint32_t smallest[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool surrogate = code >= 0xd800 && code < 0xe000;
  return code < smallest[length] || code > 0x10ffff || surrogate ? 0 : length;
}

/// C0, DEL, C1 and the two Unicode line separators would break a line or drive a terminal.
bool is_control(std::string_view sequence) {
  const auto first = static_cast<unsigned char>(sequence[0]);
  if (sequence.size() == 1) {
    return first < 0x20 || first == 0x7f;
  }
  return (first == 0xc2 && static_cast<unsigned char>(sequence[1]) < 0xa0) || sequence == "\xe2\x80\xa8" ||
         sequence == "\xe2\x80\xa9";
}

}  // namespace

std::string printable(std::string_view text) {
  std::string result;
  result.reserve(text.size());
  while (!text.empty()) {
    const std::size_t length = sequence_length(text);
    const std::string_view sequence = text.substr(0, length == 0 ? 1 : length);
    if (length == 0 || is_control(sequence)) {
      result += "\xef\xbf\xbd";
    } else {
      result += sequence;
    }
    text.remove_prefix(sequence.size());
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

}  // namespace ridgecraft::mesh
