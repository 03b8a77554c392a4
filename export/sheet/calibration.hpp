// SPDX-License-Identifier: GPL-3.0-or-later
// Printers and plotters that print everything a little too large or too small.
#pragma once

#include "export/sheet/drawing.hpp"

namespace ridgecraft::export_ {

/// The page as it has to be drawn for a machine on which 100 mm come out as `measured` mm (x across the
/// sheet, y up): places on both sides shrink and grow about the sheet's middle, and come out where they were
/// meant. The sizes of letters and the widths of lines stay.
[[nodiscard]] Drawing calibrated(Drawing page, Vec2 measured);

}  // namespace ridgecraft::export_
