// SPDX-License-Identifier: GPL-3.0-or-later
// Pages that tests of machine files read.
#pragma once

#include <vector>

#include "export/sheet/drawing.hpp"

namespace ridgecraft::test {

/// A cube, a ball in many pieces, and a corner of cubes with valley folds, on sheets of several sizes.
[[nodiscard]] std::vector<export_::Drawing> pages_for_machines();

}  // namespace ridgecraft::test
