// SPDX-License-Identifier: GPL-3.0-or-later
// Many numbers in order, faster than by comparing them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace ridgecraft {

/// The positions of some numbers, none of them negative or NaN, from the smallest number up; equal ones stay
/// in the order that they have. There are fewer than 2^32. By their digits: linear.
[[nodiscard]] std::vector<std::uint32_t> ascending_order(std::span<const float> numbers);

/// The same from the largest down; equal ones stay in the order that they have, too.
[[nodiscard]] std::vector<std::uint32_t> descending_order(std::span<const float> numbers);

}  // namespace ridgecraft
