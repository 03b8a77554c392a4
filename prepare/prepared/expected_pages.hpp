// SPDX-License-Identifier: GPL-3.0-or-later
// How much paper a model takes, before anything is unfolded.
#pragma once

#include "base/vector.hpp"
#include "prepare/prepared/prepared.hpp"

namespace ridgecraft::prepare {

/// Pages of a printable area that pieces of so much area fill.
[[nodiscard]] double pages_filled(double area, Vec2 printable);

/// About how many pages the model takes: flat regions larger than half a page one each, the others by their
/// area. O(n).
[[nodiscard]] double expected_pages(const Prepared& prepared, Vec2 printable);

}  // namespace ridgecraft::prepare
