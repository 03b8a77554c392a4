// SPDX-License-Identifier: GPL-3.0-or-later
// A segmentation as a text file: one part number per polygon of the input.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "mesh/model/model.hpp"
#include "segment/segment.hpp"

namespace ridgecraft::cli {

/// Part of each polygon of the input, in its order.
using Labels = std::vector<std::uint32_t>;

/// Of a polygon without a face; -1 in files.
constexpr std::uint32_t no_part = std::numeric_limits<std::uint32_t>::max();

[[nodiscard]] Labels polygon_labels(const mesh::Model& model, const segment::Segmentation& segmentation);

/// One line per polygon.
[[nodiscard]] std::string label_text(const Labels& labels);

/// The labels in a file that should have one for each of `polygons`. Throws Error(unreadable_input).
[[nodiscard]] Labels read_labels(const std::string& file, std::size_t polygons);

}  // namespace ridgecraft::cli
