// SPDX-License-Identifier: GPL-3.0-or-later
// What a user may want to stop for, told before nets are searched.
#pragma once

#include <optional>
#include <string>

#include "cli/arguments/options.hpp"
#include "export/sheet/paper.hpp"
#include "mesh/mesh.hpp"
#include "prepare/prepare.hpp"

namespace ridgecraft::cli {

/// From here on a user is warned.
inline constexpr double many_pages = 100.0;

/// Pages that the surface will need, in the mean: by its area, but a flat region larger than half of the
/// printable area takes a page for itself.
[[nodiscard]] double expected_pages(const prepare::Prepared& prepared, Vec2 printable);

/// "this takes about 1200 pages; --size 14mm would take about 10". Expected pages are told in two digits,
/// counted ones all.
[[nodiscard]] std::string many_pages_warning(const mesh::Surface& surface, Vec2 printable, double pages,
                                             bool counted);

/// Where a size without a unit makes a tiny model: whoever wrote it may have meant centimetres.
[[nodiscard]] std::optional<std::string> assumed_unit_warning(const SizeArguments& size);

/// Where half of the folds are too short for fingers: how long the middle one is, and which size would do.
[[nodiscard]] std::optional<std::string> too_small_warning(const prepare::Prepared& prepared);

/// Where the margin is narrower than most printers need.
[[nodiscard]] std::optional<std::string> narrow_margin_warning(const paper::Paper& paper);

}  // namespace ridgecraft::cli
