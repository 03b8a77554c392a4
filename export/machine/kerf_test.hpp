// SPDX-License-Identifier: GPL-3.0-or-later
// A small piece by which the kerf of a beam is measured.
#pragma once

#include <vector>

#include "export/sheet/drawing.hpp"
#include "export/sheet/paper.hpp"

namespace ridgecraft::export_ {

/// Sides of the test piece and of the hole in it, mm. Cut with the right kerf they measure just that; with
/// none the piece is a kerf too small and the hole a kerf too large.
inline constexpr double kerf_test_mm = 20.0;
inline constexpr double kerf_test_hole_mm = 10.0;

/// Puts the test piece on the first page that has room for it beside its pieces, else on a page of its own at
/// the end. O(places of a grid of 4 mm * sides of the pages).
void add_kerf_test(std::vector<Drawing>& pages, const Paper& paper);

}  // namespace ridgecraft::export_
