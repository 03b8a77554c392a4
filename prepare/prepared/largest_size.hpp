// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace ridgecraft::prepare {

/// A hundred metres of paper model; beyond that a slip of the unit is certain, and the model is refused when
/// it is brought to its size.
inline constexpr double largest_size_mm = 1e5;

}  // namespace ridgecraft::prepare
