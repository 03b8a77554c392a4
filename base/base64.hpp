// SPDX-License-Identifier: GPL-3.0-or-later
// Bytes as letters, for files inside text.
#pragma once

#include <string>
#include <string_view>

namespace ridgecraft {

/// RFC 4648, with padding. O(n).
[[nodiscard]] std::string base64(std::string_view bytes);

}  // namespace ridgecraft
