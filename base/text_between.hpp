// SPDX-License-Identifier: GPL-3.0-or-later
// A text by its ends.
#pragma once

#include <cstddef>
#include <string_view>

namespace ridgecraft {

/// The text from `first` up to `last`. std::string_view takes two pointers since C++20, but not in every
/// library that the program is built with (wasm/).
[[nodiscard]] constexpr std::string_view text_between(const char* first, const char* last) {
  return {first, static_cast<std::size_t>(last - first)};
}

}  // namespace ridgecraft
