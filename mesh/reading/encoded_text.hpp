// SPDX-License-Identifier: GPL-3.0-or-later
// Bytes that are written as text: base64, and the percent signs of addresses.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace ridgecraft::mesh {

/// The bytes of a base64 text (RFC 4648), also of its variant for addresses; with or without the equals signs
/// at its end. Nothing where it is no such text.
[[nodiscard]] std::optional<std::string> from_base64(std::string_view text);

/// "%20" becomes a blank and so on; a percent sign without two hexadecimal digits stays as it is.
[[nodiscard]] std::string from_percent(std::string_view text);

}  // namespace ridgecraft::mesh
