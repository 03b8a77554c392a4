// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

namespace ridgecraft {

/// What stands for no index, where plain numbers are used in place of base/id.hpp.
inline constexpr std::uint32_t no_index = 0xffffffffU;

}  // namespace ridgecraft
