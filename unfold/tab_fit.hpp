// SPDX-License-Identifier: GPL-3.0-or-later
// Tabs that make a piece too large for the sheet.
#pragma once

#include "unfold/nets.hpp"
#include "unfold/unfold.hpp"

namespace ridgecraft::unfold {

/// Takes tabs away, largest first, from each piece that fits the sheet without them but not with them (a face
/// nearly as large as the sheet: splitting can't help there). Their joins say that there was no room.
/// O(pieces h^2) where all fit.
void drop_tabs_beyond_sheet(const Sheet& sheet, Nets& nets);

}  // namespace ridgecraft::unfold
