// SPDX-License-Identifier: GPL-3.0-or-later
// Quantities as people type them: "150mm", "6in", "1:50", "30%".
#pragma once

#include <optional>
#include <string_view>

namespace ridgecraft::cli {

/// Millimetres of "150mm", "15cm", "0.15m", "6in", "6\"", "2ft"; a number alone is mm. Nothing when the text
/// isn't a finite length above zero (or, with `zero_allowed`, at least zero).
[[nodiscard]] std::optional<double> parse_length_mm(std::string_view text, bool zero_allowed = false);

/// The factor of "1:50", "2:1", "0.5", "30%"; nothing when it isn't finite and above zero.
[[nodiscard]] std::optional<double> parse_scale(std::string_view text);

}  // namespace ridgecraft::cli
