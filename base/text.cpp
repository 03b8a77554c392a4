// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <system_error>
#include <vector>

#include <fmt/format.h>

namespace ridgecraft {

Utf8Character first_character(std::string_view utf8) {
  constexpr Utf8Character wrong{replacement_character, 1};
  const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(utf8[i]); };
  const std::uint8_t first = byte(0);
  if (first < 0x80) {
    return {first, 1};
  }
  const std::size_t length = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4 || utf8.size() < length) {
    return wrong;
  }
  char32_t code = first & (0xFFU >> (length + 1));
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0U) != 0x80U) {
      return wrong;
    }
    code = (code << 6U) | (byte(i) & 0x3FU);
  }
  constexpr char32_t smallest[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool surrogate = code >= 0xD800 && code <= 0xDFFF;
  return code < smallest[length] || code > 0x10FFFF || surrogate ? wrong : Utf8Character{code, length};
}

void append_utf8(std::string& out, char32_t code) {
  const auto put = [&](char32_t byte) { out.push_back(static_cast<char>(static_cast<std::uint8_t>(byte))); };
  if (code < 0x80) {
    put(code);
  } else if (code < 0x800) {
    put(0xC0 | (code >> 6U));
    put(0x80 | (code & 0x3FU));
  } else if (code < 0x10000) {
    put(0xE0 | (code >> 12U));
    put(0x80 | ((code >> 6U) & 0x3FU));
    put(0x80 | (code & 0x3FU));
  } else {
    put(0xF0 | (code >> 18U));
    put(0x80 | ((code >> 12U) & 0x3FU));
    put(0x80 | ((code >> 6U) & 0x3FU));
    put(0x80 | (code & 0x3FU));
  }
}

namespace {

/// Code points that Unicode keeps for itself: no file format takes them all.
bool is_noncharacter(char32_t code) {
  return (code & 0xFFFEU) == 0xFFFEU || (code >= 0xFDD0 && code <= 0xFDEF);
}

/// Marks that turn the direction of what follows: a line with one could seem to say something else.
bool is_direction_mark(char32_t code) {
  return code == 0x061C || code == 0x200E || code == 0x200F || (code >= 0x202A && code <= 0x202E) ||
         (code >= 0x2066 && code <= 0x2069);
}

bool forbidden(char32_t code) {
  return is_control(code) || is_noncharacter(code);
}

char lower(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) {
    row[j] = j;
  }
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = diagonal + (lower(a[i - 1]) == lower(b[j - 1]) ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({replaced, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row[b.size()];
}

struct Unit {
  std::string_view word;
  double mm;
};
/// No word stands before a longer one that begins like it.
constexpr std::array units{Unit{"mm", 1.0},    Unit{"cm", 10.0}, Unit{"m", 1000.0}, Unit{"inches", 25.4},
                           Unit{"inch", 25.4}, Unit{"in", 25.4}, Unit{"\"", 25.4},  Unit{"ft", 304.8}};

}  // namespace

std::vector<char32_t> code_points(std::string_view utf8) {
  std::vector<char32_t> codes;
  codes.reserve(utf8.size());
  while (!utf8.empty()) {
    const auto [code, length] = first_character(utf8);
    codes.push_back(forbidden(code) ? U' ' : code);
    utf8.remove_prefix(length);
  }
  return codes;
}

std::string printable_utf8(std::string_view utf8) {
  std::string out;
  out.reserve(utf8.size());
  for (const char32_t code : code_points(utf8)) {
    append_utf8(out, code);
  }
  return out;
}

/// Words of a file are cut here, so that a message stays one line on a screen.
constexpr std::size_t longest_quotation = 40;

std::string printable(std::string_view text) {
  std::string result;
  result.reserve(text.size());
  while (!text.empty()) {
    const auto [code, length] = first_character(text);
    append_utf8(result, forbidden(code) || is_direction_mark(code) ? replacement_character : code);
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

std::string counted(std::size_t count, const std::string& word) {
  return fmt::format("{} {}{}", count, word, count == 1 ? "" : "s");
}

std::string listed(const std::vector<std::string>& words, const std::string& conjunction) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) {
    text += i == 0 ? "" : i + 1 == words.size() ? " " + conjunction + " " : ", ";
    text += words[i];
  }
  return text;
}

std::string nearest_word(std::string_view word, std::span<const std::string> known) {
  std::string nearest;
  std::size_t best = word.size() / 3 + 2;
  for (const std::string& candidate : known) {
    const std::size_t distance = edit_distance(word.substr(0, 64), candidate);
    if (distance < best) {
      best = distance;
      nearest = candidate;
    }
  }
  return nearest;
}

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) {
    return {};
  }
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

std::optional<double> unit_mm(std::string_view word) {
  for (const Unit& unit : units) {
    if (unit.word == word) {
      return unit.mm;
    }
  }
  return std::nullopt;
}

std::optional<LengthText> take_length(std::string_view& text) {
  text = trimmed(text);
  LengthText length;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), length.number);
  if (error != std::errc()) {
    return std::nullopt;
  }
  text = trimmed(text.substr(static_cast<std::size_t>(end - text.data())));
  for (const Unit& unit : units) {
    if (text.starts_with(unit.word)) {
      length.mm_per_unit = unit.mm;
      text = trimmed(text.substr(unit.word.size()));
      break;
    }
  }
  return length;
}

}  // namespace ridgecraft
