// SPDX-License-Identifier: GPL-3.0-or-later
// Which points lie at one place.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/vector.hpp"

namespace ridgecraft {

/// Of each point the first one with the same coordinates: itself where there is none before. `counts[i]` ==
/// 0: point i is left out, and is its own first; empty when none is. Expected O(n).
[[nodiscard]] std::vector<std::uint32_t> first_at_place(std::span<const Vec3> points,
                                                        std::span<const std::uint8_t> counts = {});

}  // namespace ridgecraft
