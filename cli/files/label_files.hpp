// SPDX-License-Identifier: GPL-3.0-or-later
// A segmentation as a text file: one part number per polygon of the input.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace ridgecraft::cli {

/// Part of each polygon of the input, in its order: segment::polygon_labels.
using Labels = std::vector<std::uint32_t>;

/// One line per polygon; -1 where it has no part.
[[nodiscard]] std::string label_text(const Labels& labels);

/// The labels in a file that should have one for each of `polygons`. Throws Error(unreadable_input).
[[nodiscard]] Labels read_labels(const std::string& file, std::size_t polygons);

}  // namespace ridgecraft::cli
