// SPDX-License-Identifier: GPL-3.0-or-later
// Bytes as letters, for pictures inside text files. Private to export/formats/.
#pragma once

#include <string>
#include <string_view>

namespace ridgecraft::paper {

/// RFC 4648, with padding. O(n).
[[nodiscard]] std::string base64(std::string_view bytes);

}  // namespace ridgecraft::paper
