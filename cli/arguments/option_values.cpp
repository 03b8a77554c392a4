// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/arguments/option_values.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>
#include <system_error>

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/length_text.hpp"
#include "base/sentence.hpp"
#include "cli/arguments/units.hpp"

namespace ridgecraft::cli {
namespace {

/// The number that is the whole text, if it lies between these.
std::optional<double> number_within(std::string_view text, double low, double high) {
  double value = NAN;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole = error == std::errc() && end == text.data() + text.size();
  return whole && value >= low && value <= high ? std::optional(value) : std::nullopt;
}

}  // namespace

void refuse(const std::string& sentence) {
  throw Error(ErrorKind::usage, sentence);
}

void require(const std::string& value, const std::string& what, const std::string& verb) {
  if (value.empty()) {
    refuse(what + "; see " + verb + " --help");
  }
}

double length_or_refuse(const std::string& option, const std::string& text, bool zero_allowed) {
  if (const auto mm = parse_length_mm(text, zero_allowed)) {
    return *mm;
  }
  if (std::string with_point = text; std::count(text.begin(), text.end(), ',') == 1) {
    std::replace(with_point.begin(), with_point.end(), ',', '.');
    if (parse_length_mm(with_point, zero_allowed)) {
      refuse(option + " takes a decimal point: " + option + " " + with_point);
    }
  }
  refuse(option + " takes a length such as 150mm, 15cm or 6in, not '" + text + "'");
}

double unit_or_refuse(const std::string& option, const std::string& text) {
  const auto mm = unit_mm(text.empty() ? "mm" : text);
  if (!mm) {
    refuse(option + " takes mm, cm, m, in or ft, not '" + text + "'");
  }
  return *mm;
}

double number_or_refuse(const std::string& option, const std::string& text, double low, double high) {
  const auto value = number_within(text, low, high);
  if (!value) {
    refuse(fmt::format("{} takes a number from {} to {}, not '{}'", option, low, high, text));
  }
  return *value;
}

void refuse_choice(const std::string& option, const std::vector<std::string>& words,
                   const std::string& text) {
  refuse(option + " takes " + listed(words, "or") + ", not '" + text + "'");
}

double percent_or_refuse(const std::string& option, const std::string& text, double low, double high) {
  const auto value =
      number_within(std::string_view(text).substr(0, text.size() - (text.ends_with('%') ? 1 : 0)), low, high);
  if (!value) {
    refuse(fmt::format("{} takes a percentage from {} to {}, not '{}'", option, low, high, text));
  }
  return *value / 100.0;
}

void require_range(const std::string& option, const std::string& text, double value, double low, double high,
                   const std::string& range) {
  if (!(value >= low && value <= high)) {
    refuse(option + " takes " + range + ", not '" + text + "'");
  }
}

std::uint64_t whole_number_or_refuse(const std::string& option, const std::string& text,
                                     std::uint64_t least) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || value < least) {
    refuse(fmt::format("{} takes a whole number from {} on, not '{}'", option, least, text));
  }
  return value;
}

double concavity_or_refuse(const std::string& text) {
  return text.empty() ? 0.1 : number_or_refuse("--concavity", text, 0.001, 2.0);
}

}  // namespace ridgecraft::cli
