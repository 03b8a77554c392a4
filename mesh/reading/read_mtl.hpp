// SPDX-License-Identifier: GPL-3.0-or-later
// The material files of an OBJ file.
#pragma once

#include <string_view>
#include <vector>

#include "mesh/reading/source.hpp"

namespace ridgecraft::mesh {

/// Fills in the materials of a soup. `libraries` are what the mtllib lines say, `names` the materials' names
/// as the OBJ file has them. Each file is read once. What is missing or wrong leaves a material white or
/// without picture and is remarked on; nothing is thrown but interruptions. Does nothing where the source has
/// no folder.
void read_material_files(const Source& source, const std::vector<std::string_view>& libraries,
                         const std::vector<std::string_view>& names, Soup& soup);

}  // namespace ridgecraft::mesh
