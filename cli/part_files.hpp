// SPDX-License-Identifier: GPL-3.0-or-later
// A segmentation as files: one part number per polygon, one colour per face.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "mesh/model.hpp"
#include "mesh/write.hpp"
#include "segment/segment.hpp"

namespace ridgecraft::cli {

/// One line per polygon of the input, in its order: its part's number, -1 for a polygon without a face.
[[nodiscard]] std::string label_text(const mesh::Model& model, const segment::Segmentation& segmentation);

/// A colour per face; neighbouring numbers get colours that are easy to tell apart.
[[nodiscard]] mesh::FaceColours part_colours(const segment::Segmentation& segmentation);

/// The bytes of a PLY or OFF file with a comment near its top.
[[nodiscard]] std::string with_comment(std::string mesh_file, const std::string& comment);

}  // namespace ridgecraft::cli
