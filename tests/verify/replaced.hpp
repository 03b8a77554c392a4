// SPDX-License-Identifier: GPL-3.0-or-later
// Texts with one thing changed, for tests that break files.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include <catch2/catch.hpp>

namespace ridgecraft::test {

/// The text with another in the first place of one that it must hold.
[[nodiscard]] inline std::string replaced(std::string text, std::string_view from, std::string_view to) {
  const std::size_t at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

}  // namespace ridgecraft::test
