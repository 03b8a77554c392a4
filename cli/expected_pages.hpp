// SPDX-License-Identifier: GPL-3.0-or-later
// How many pages a model will take, before its nets are made: a user may want to stop.
#pragma once

#include <string>

#include "mesh/mesh.hpp"

namespace ridgecraft::cli {

/// From here on a user is warned.
inline constexpr double many_pages = 100.0;

/// Pages that the surface will need, in the mean: by its area, but a flat region larger than half of the
/// printable area takes a page for itself.
[[nodiscard]] double expected_pages(const mesh::Prepared& prepared, Vec2 printable);

/// "this takes about 1200 pages; --size 14mm would take about 10". Expected pages are told in two digits,
/// counted ones all.
[[nodiscard]] std::string many_pages_warning(const mesh::Surface& surface, Vec2 printable, double pages,
                                             bool counted);

}  // namespace ridgecraft::cli
