// SPDX-License-Identifier: GPL-3.0-or-later
// What the readers of all formats share: layers by name, patterns by dashes, the words that pages carry.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "verify/file/file.hpp"
#include "verify/pages/printed.hpp"

namespace ridgecraft::verify {

/// Leaves a reader with the reason why the file can't be checked.
template <typename... Args>
[[noreturn]] void cannot_check(fmt::format_string<Args...> text, Args&&... args) {
  throw NotInForm{fmt::format(text, std::forward<Args>(args)...)};
}

/// The layer with this plain id ("tab-fold") or title ("Tab folds"); nothing if the format has no such layer.
[[nodiscard]] std::optional<PrintedLayer> layer_with_id(std::string_view id);
[[nodiscard]] std::optional<PrintedLayer> layer_with_title(std::string_view title);

/// Of which lines are kept; what else such a layer holds would be overlooked.
[[nodiscard]] constexpr bool is_checked(PrintedLayer layer) {
  return layer != PrintedLayer::other;
}

/// Dash, gap, dash, gap ...
[[nodiscard]] Pattern pattern_of(std::span<const double> dashes);

/// The hexadecimal digits behind "ridgecraft-model:", or nothing.
[[nodiscard]] std::string digest_in(std::string_view text);

/// The name behind "preset:" among the words that a file bears, or nothing.
[[nodiscard]] std::string preset_in(std::string_view text);

/// What the text that a file tells its settings in says of the board that it was made for; 0 for paper.
[[nodiscard]] double thickness_in(std::string_view settings);

/// Takes back what pages were drawn larger or smaller for a printer (--calibrate): `settings` is the text
/// that the file tells its settings in; nothing changes where it says nothing of it.
void undo_calibration(std::string_view settings, PrintedFile& file);

/// Fills number and count from words that end in "page 2 of 3".
void read_page_words(std::string_view words, PrintedPage& page);

}  // namespace ridgecraft::verify
