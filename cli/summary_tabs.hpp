// SPDX-License-Identifier: GPL-3.0-or-later
// What the summaries tell of glue tabs.
#pragma once

#include <string>

#include "unfold/nets.hpp"

namespace ridgecraft::cli {

[[nodiscard]] std::size_t joins_without_tab(const unfold::Nets& nets);
/// Joins that could have no usable tab however the model is cut.
[[nodiscard]] std::size_t joins_too_narrow(const unfold::Nets& nets);

/// A line: how many tabs, how many are lower than asked where that isn't the default, which joins have none
/// and why.
[[nodiscard]] std::string tabs_text(const unfold::Nets& nets, double asked_mm);

}  // namespace ridgecraft::cli
