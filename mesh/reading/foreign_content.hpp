// SPDX-License-Identifier: GPL-3.0-or-later
// What a file that is no mesh of ours is instead.
#pragma once

#include <optional>
#include <string_view>

namespace ridgecraft::mesh {

/// As "a PNG picture"; nothing where that can't be seen.
[[nodiscard]] std::optional<std::string_view> foreign_content(std::string_view bytes);

}  // namespace ridgecraft::mesh
