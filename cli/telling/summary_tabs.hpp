// SPDX-License-Identifier: GPL-3.0-or-later
// What the summaries tell of glue tabs.
#pragma once

#include <string>

#include "mesh/model/surface.hpp"
#include "unfold/net/nets.hpp"
#include "unfold/unfold.hpp"

namespace ridgecraft::cli {

[[nodiscard]] std::size_t joins_without_tab(const unfold::Nets& nets);
/// Joins that could have no usable tab however the model is cut.
[[nodiscard]] std::size_t joins_too_narrow(const unfold::Nets& nets);

/// A line: how many tabs, how many of them are usable where not all are, how many are lower than asked where
/// that isn't the default, which joins have none and why.
[[nodiscard]] std::string tabs_text(const mesh::Surface& surface, const unfold::Nets& nets,
                                    const unfold::TabOptions& options);

}  // namespace ridgecraft::cli
