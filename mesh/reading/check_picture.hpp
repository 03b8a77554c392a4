// SPDX-License-Identifier: GPL-3.0-or-later
// Whether a texture can be used: looked at from outside, without decoding it.
#pragma once

#include <string>
#include <string_view>

namespace ridgecraft::mesh {

/// Empty for a PNG or JPEG picture that is there to its end; otherwise what is wrong with it, as "is empty".
[[nodiscard]] std::string picture_fault(std::string_view bytes);

}  // namespace ridgecraft::mesh
