// SPDX-License-Identifier: GPL-3.0-or-later
// Text of unknown origin (file names, words of a file) made fit for a message of one line.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace ridgecraft {

/// The text as valid UTF-8 without control characters: each byte that is not part of a valid sequence and
/// each control character becomes U+FFFD.
[[nodiscard]] std::string printable(std::string_view text);

/// The same, cut after about 40 characters.
[[nodiscard]] std::string shortened(std::string_view text);

/// The same, in quotation marks.
[[nodiscard]] std::string in_quotes(std::string_view text);

}  // namespace ridgecraft
