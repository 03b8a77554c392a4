// SPDX-License-Identifier: GPL-3.0-or-later
// Text files, appended to piece by piece. Private to export/formats/.
#pragma once

#include <iterator>
#include <string>
#include <utility>

#include <fmt/format.h>

namespace ridgecraft::paper {

template <class... Args>
void append(std::string& out, fmt::format_string<Args...> format, Args&&... args) {
  fmt::format_to(std::back_inserter(out), format, std::forward<Args>(args)...);
}

/// At most four decimals (0.1 micrometre), no trailing zeros, no negative zero.
[[nodiscard]] inline std::string decimals(double value) {
  std::string text = fmt::format("{:.4f}", value);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') {
    text.pop_back();
  }
  return text == "-0" ? "0" : text;
}

}  // namespace ridgecraft::paper
