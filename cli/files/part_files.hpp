// SPDX-License-Identifier: GPL-3.0-or-later
// A segmentation as files: a coloured mesh, one number a polygon, all segmentations at once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "mesh/mesh.hpp"
#include "mesh/model/model.hpp"
#include "segment/hierarchy.hpp"
#include "segment/segment.hpp"

namespace ridgecraft::cli {

/// A colour per face; neighbouring numbers get colours that are easy to tell apart.
[[nodiscard]] mesh::FaceColours part_colours(const segment::Segmentation& segmentation);

/// The bytes of a PLY or OFF file with a comment near its top.
[[nodiscard]] std::string with_comment(std::string mesh_file, const std::string& comment);

/// Part of each polygon of the input, in its order: segment::polygon_labels.
using Labels = std::vector<std::uint32_t>;

/// One line per polygon; -1 where it has no part.
[[nodiscard]] std::string label_text(const Labels& labels);

/// The labels in a file that should have one for each of `polygons`. Throws Error(unreadable_input).
[[nodiscard]] Labels read_labels(const std::string& file, std::size_t polygons);

/// One JSON object in one line: the leaf of each polygon, and which nodes were joined at which
/// concavity. Carries the mark of the model. O(n).
[[nodiscard]] std::string hierarchy_text(const mesh::Model& model, const segment::Hierarchy& hierarchy);

}  // namespace ridgecraft::cli
