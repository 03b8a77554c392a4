// SPDX-License-Identifier: GPL-3.0-or-later
// What is done to an arrangement when its pages are settled: none looks forgotten, and they get their order.
#pragma once

#include "export/packing/packing_fill.hpp"

namespace ridgecraft::paper {

/// Where a page holds next to nothing, it gets shapes of the same groups (or of the next ones) from fuller
/// pages.
void share_with_lonely_page(PackingFill& fill, Arrangement& a);

/// Pages in the order of the groups on them, but one that is much emptier than all others last.
void order_pages(const PackingTask& task, Arrangement& a);

}  // namespace ridgecraft::paper
