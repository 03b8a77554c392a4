// SPDX-License-Identifier: GPL-3.0-or-later
// Flat regions that are too large for the sheet, or that overlap themselves, are divided before anything else
// is done.
#pragma once

#include <string>
#include <vector>

#include "base/context.hpp"
#include "mesh/model/surface.hpp"
#include "prepare/prepared/panels.hpp"
#include "unfold/patch/room.hpp"

namespace ridgecraft::unfold {

/// The same panels, but those that no piece could hold whole are divided into as few as possible that fit the
/// room; a note says how many there were. Each face alone must fit. O(n) but for the divided ones.
[[nodiscard]] prepare::Panels fitting_panels(const mesh::Surface& surface, const prepare::Panels& panels,
                                             const Room& room, const Context& context,
                                             std::vector<std::string>& notes);

}  // namespace ridgecraft::unfold
