// SPDX-License-Identifier: GPL-3.0-or-later
// Rows of small words on a page: the index, lists of numbers.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "export/sheet/drawing.hpp"

namespace ridgecraft::export_ {

inline constexpr double table_text_height = 1.9;  ///< mm
inline constexpr double table_row_height = 3.1;   ///< baseline to baseline, mm

/// Appends words in rows no wider than `width` (mm), those after the first one indented. A word that is wider
/// by itself has a row of its own.
void append_wrapped(std::vector<std::string>& rows, std::string_view text, double width);

/// The rows with their upper left corner at the origin.
[[nodiscard]] std::vector<Text> table(const std::vector<std::string>& rows);

}  // namespace ridgecraft::export_
