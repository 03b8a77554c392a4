// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/arguments/units.hpp"

#include <charconv>
#include <cmath>
#include <system_error>

#include "base/length_text.hpp"

namespace ridgecraft::cli {
namespace {

/// Takes a number off the front of `text`, and the blanks around it.
std::optional<double> take_number(std::string_view& text) {
  text = trimmed(text);
  double number = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc()) {
    return std::nullopt;
  }
  text = trimmed(text.substr(static_cast<std::size_t>(end - text.data())));
  return number;
}

}  // namespace

std::optional<double> parse_length_mm(std::string_view text, bool zero_allowed) {
  const auto length = take_length(text);
  if (!length || !text.empty()) {
    return std::nullopt;
  }
  const double value = length->number * length->mm_per_unit.value_or(1.0);
  const bool in_range = value > 0.0 || (zero_allowed && value == 0.0);
  return in_range && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

std::optional<double> parse_scale(std::string_view text) {
  const auto first = take_number(text);
  if (!first) {
    return std::nullopt;
  }
  double factor = *first;
  if (text == "%") {
    factor /= 100.0;
  } else if (text.starts_with(':')) {
    text.remove_prefix(1);
    const auto second = take_number(text);
    if (!second || !text.empty() || *second == 0.0) {
      return std::nullopt;
    }
    factor /= *second;
  } else if (!text.empty()) {
    return std::nullopt;
  }
  return factor > 0.0 && std::isfinite(factor) ? std::optional(factor) : std::nullopt;
}

}  // namespace ridgecraft::cli
