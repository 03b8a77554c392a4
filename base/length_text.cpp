// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/length_text.hpp"

#include <array>
#include <charconv>
#include <system_error>

namespace ridgecraft {
namespace {

struct Unit {
  std::string_view word;
  double mm;
};
/// No word stands before a longer one that begins like it.
constexpr std::array units{Unit{"mm", 1.0},    Unit{"cm", 10.0}, Unit{"m", 1000.0}, Unit{"inches", 25.4},
                           Unit{"inch", 25.4}, Unit{"in", 25.4}, Unit{"\"", 25.4},  Unit{"ft", 304.8}};

}  // namespace

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
