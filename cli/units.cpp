// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/units.hpp"

#include <charconv>
#include <cmath>
#include <system_error>

namespace ridgecraft::cli {
namespace {

struct NumberAndRest {
  double number;
  std::string_view rest;
};

std::optional<NumberAndRest> leading_number(std::string_view text) {
  double number = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || !std::isfinite(number)) {
    return std::nullopt;
  }
  return NumberAndRest{number, text.substr(static_cast<std::size_t>(end - text.data()))};
}

std::string_view trim(std::string_view text) {
  while (!text.empty() && text.front() == ' ') {
    text.remove_prefix(1);
  }
  while (!text.empty() && text.back() == ' ') {
    text.remove_suffix(1);
  }
  return text;
}

}  // namespace

std::optional<double> unit_mm(std::string_view word) {
  if (word == "mm") {
    return 1.0;
  }
  if (word == "cm") {
    return 10.0;
  }
  if (word == "m") {
    return 1000.0;
  }
  if (word == "in" || word == "inch" || word == "\"") {
    return 25.4;
  }
  if (word == "ft") {
    return 304.8;
  }
  return std::nullopt;
}

std::optional<double> parse_length_mm(std::string_view text, bool zero_allowed) {
  const auto parsed = leading_number(trim(text));
  if (!parsed) {
    return std::nullopt;
  }
  const std::string_view word = trim(parsed->rest);
  const auto unit = word.empty() ? std::optional(1.0) : unit_mm(word);
  if (!unit) {
    return std::nullopt;
  }
  const double value = parsed->number * *unit;
  const bool in_range = value > 0.0 || (zero_allowed && value == 0.0);
  return in_range && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

std::optional<double> parse_scale(std::string_view text) {
  const auto first = leading_number(trim(text));
  if (!first) {
    return std::nullopt;
  }
  double factor = first->number;
  const std::string_view rest = trim(first->rest);
  if (rest == "%") {
    factor /= 100.0;
  } else if (!rest.empty() && rest.front() == ':') {
    const auto second = leading_number(trim(rest.substr(1)));
    if (!second || !second->rest.empty() || second->number == 0.0) {
      return std::nullopt;
    }
    factor /= second->number;
  } else if (!rest.empty()) {
    return std::nullopt;
  }
  return factor > 0.0 && std::isfinite(factor) ? std::optional(factor) : std::nullopt;
}

}  // namespace ridgecraft::cli
