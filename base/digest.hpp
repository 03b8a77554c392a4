// SPDX-License-Identifier: GPL-3.0-or-later
// A short name for many bytes.
#pragma once

#include <string>
#include <string_view>

namespace ridgecraft {

/// 16 hexadecimal digits that stand for these bytes: a 64-bit hash, the same on every machine. Not
/// cryptographic.
[[nodiscard]] std::string digest(std::string_view bytes);

}  // namespace ridgecraft
