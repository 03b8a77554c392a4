// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/option_values.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/text.hpp"

namespace ridgecraft {
namespace {

/// The number that is the whole text, if it lies between these.
std::optional<double> number_within(std::string_view text, double low, double high) {
  double value = NAN;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole = error == std::errc() && end == text.data() + text.size();
  return whole && value >= low && value <= high ? std::optional(value) : std::nullopt;
}

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

/// Any length, of either sign.
std::optional<double> finite_length_mm(std::string_view text) {
  const auto length = take_length(text);
  const double mm =
      length && text.empty() ? length->number * length->mm_per_unit.value_or(1.0) : std::nan("");
  return std::isfinite(mm) ? std::optional(mm) : std::nullopt;
}

Message not_within(std::string_view code, const std::string& option, std::pair<double, double> range,
                   const std::string& text) {
  return Message(code, {{"option", option},
                        {"low", fmt::format("{}", range.first)},
                        {"high", fmt::format("{}", range.second)},
                        {"text", text}});
}

}  // namespace

void refuse(const Message& message) {
  throw Error(ErrorKind::usage, message);
}

void refuse(const std::string& sentence) {
  throw Error(ErrorKind::usage, sentence);
}

std::optional<double> parse_length_mm(std::string_view text) {
  const auto mm = finite_length_mm(text);
  return mm && *mm > 0.0 ? mm : std::nullopt;
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

double length_or_refuse(const std::string& option, const std::string& text, double low, double high) {
  const auto mm = finite_length_mm(text);
  if (mm && *mm >= low && *mm <= high) {
    return *mm;
  }
  if (mm && *mm > high) {
    refuse(Message("option_length_range", {{"option", option},
                                           {"low", fmt::format("{:g}", low)},
                                           {"high", fmt::format("{:g}", high)},
                                           {"text", text}}));
  }
  if (mm && low > 0.0) {
    refuse(Message("option_length_low",
                   {{"option", option}, {"text", text}, {"low", fmt::format("{:g}", low)}}));
  }
  if (std::string with_point = text; std::count(text.begin(), text.end(), ',') == 1) {
    std::replace(with_point.begin(), with_point.end(), ',', '.');
    if (finite_length_mm(with_point)) {
      refuse(Message("option_decimal_point", {{"option", option}, {"value", with_point}}));
    }
  }
  refuse(Message("option_length", {{"option", option}, {"text", text}}));
}

double unit_or_refuse(const std::string& option, const std::string& text) {
  const auto mm = unit_mm(text.empty() ? "mm" : text);
  if (!mm) {
    refuse(Message("option_unit", {{"option", option}, {"text", text}}));
  }
  return *mm;
}

double number_or_refuse(const std::string& option, const std::string& text, double low, double high) {
  const auto value = number_within(text, low, high);
  if (!value) {
    refuse(not_within("option_number", option, {low, high}, text));
  }
  return *value;
}

double percent_or_refuse(const std::string& option, const std::string& text, double low, double high) {
  const auto value =
      number_within(std::string_view(text).substr(0, text.size() - (text.ends_with('%') ? 1 : 0)), low, high);
  if (!value) {
    refuse(not_within("option_percentage", option, {low, high}, text));
  }
  return *value / 100.0;
}

std::uint64_t whole_number_or_refuse(const std::string& option, const std::string& text, std::uint64_t least,
                                     std::uint64_t most) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || value < least || value > most) {
    const bool has_most = most != std::numeric_limits<std::uint64_t>::max();
    refuse(Message(has_most ? "option_whole" : "option_whole_from",
                   {{"option", option}, {"low", least}, {"high", most}, {"text", text}}));
  }
  return value;
}

std::size_t word_or_refuse(const std::string& option, const std::string& text,
                           const std::vector<std::string>& words) {
  const auto found = std::find(words.begin(), words.end(), text);
  if (found == words.end()) {
    refuse(Message("option_word", {{"option", option}, {"words", plain_items(words)}, {"text", text}}));
  }
  return static_cast<std::size_t>(found - words.begin());
}

}  // namespace ridgecraft
