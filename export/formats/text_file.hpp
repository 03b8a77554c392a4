// SPDX-License-Identifier: GPL-3.0-or-later
// Text files, appended to piece by piece. Private to export/formats/.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <string>
#include <utility>

#include <fmt/format.h>

namespace ridgecraft::export_ {

template <class... Args>
void append(std::string& out, fmt::format_string<Args...> format, Args&&... args) {
  fmt::format_to(std::back_inserter(out), format, std::forward<Args>(args)...);
}

/// Four decimals, as fmt has them for "{:.4f}" but for zero, which is never negative. Whole numbers of
/// ten-thousandths are quicker than the exact digits of a double; those are asked where the rounding of the
/// product could decide.
[[nodiscard]] inline std::string four_decimals(double value) {
  constexpr double most = 1e11;      // below, the product is within 0.00002
  constexpr double in_doubt = 1e-3;  // nearer to a half it isn't taken
  const double scaled = std::abs(value) * 1e4;
  const auto whole = scaled < most ? static_cast<std::uint64_t>(scaled) : 0U;
  const double rest = scaled - static_cast<double>(whole);
  if (!(scaled < most) || std::abs(rest - 0.5) < in_doubt) {
    std::string text = fmt::format("{:.4f}", value);
    return text == "-0.0000" ? "0.0000" : text;
  }
  std::uint64_t number = whole + (rest > 0.5 ? 1U : 0U);
  std::array<char, 24> digits{};
  char* const end = digits.data() + digits.size();
  char* at = end;
  const bool negative = value < 0.0 && number > 0;
  for (int i = 0; i < 6 || number > 0; ++i) {
    if (i == 4) {
      *--at = '.';
    } else {
      *--at = static_cast<char>('0' + number % 10);
      number /= 10;
    }
  }
  if (negative) {
    *--at = '-';
  }
  return {at, end};
}

/// At most four decimals (0.1 micrometre), no trailing zeros, no negative zero.
[[nodiscard]] inline std::string decimals(double value) {
  std::string text = four_decimals(value);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') {
    text.pop_back();
  }
  return text;
}

}  // namespace ridgecraft::export_
