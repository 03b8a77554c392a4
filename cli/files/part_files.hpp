// SPDX-License-Identifier: GPL-3.0-or-later
// A segmentation as a coloured mesh.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "mesh/model/model.hpp"
#include "mesh/write.hpp"
#include "segment/segment.hpp"

namespace ridgecraft::cli {

/// A colour per face; neighbouring numbers get colours that are easy to tell apart.
[[nodiscard]] mesh::FaceColours part_colours(const segment::Segmentation& segmentation);

/// The bytes of a PLY or OFF file with a comment near its top.
[[nodiscard]] std::string with_comment(std::string mesh_file, const std::string& comment);

}  // namespace ridgecraft::cli
