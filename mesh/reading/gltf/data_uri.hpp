// SPDX-License-Identifier: GPL-3.0-or-later
// Bytes that are written into an address: data:[TYPE][;base64],TEXT (RFC 2397).
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace ridgecraft::mesh {

[[nodiscard]] bool is_data_uri(std::string_view uri);

/// Nothing where the bytes can't be read.
[[nodiscard]] std::optional<std::string> data_of_uri(std::string_view uri);

}  // namespace ridgecraft::mesh
