// SPDX-License-Identifier: GPL-3.0-or-later
// Text that takes little room inside a page for browsers. Private to export/formats/.
#pragma once

#include <string>
#include <string_view>

namespace ridgecraft::paper {

/// The text as zlib packs it, in letters of UTF-8 that a script element may hold, seven eighths of a byte in
/// each; web/packed.js reads them. Seven bits, the first one the highest, are the letter of that code, but
/// for NUL, CR and '<', which HTML changes or takes for an end: the first, second or third of these and the
/// seven bits behind it are one letter of two bytes, U+0100, U+0180 or U+0200 and those bits. What fills the
/// last letter up, or the one behind it, is zero. O(n).
[[nodiscard]] std::string packed_text(std::string_view text);

}  // namespace ridgecraft::paper
