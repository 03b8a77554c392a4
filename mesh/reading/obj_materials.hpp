// SPDX-License-Identifier: GPL-3.0-or-later
// Material files of OBJ (MTL): of a material its diffuse colour (Kd) and its picture (map_Kd, with -s, -o and
// -clamp). Source: the same manual, appendix B5. Private to mesh/.
#pragma once

#include <string_view>
#include <vector>

#include "mesh/model/soup.hpp"
#include "mesh/reading/source.hpp"

namespace ridgecraft::mesh {

/// Fills in the materials of a soup. `libraries` are what the mtllib lines say, `names` the materials' names
/// as the OBJ file has them. Each file is read once. What is missing or wrong leaves a material white or
/// without picture and is remarked on; nothing is thrown but interruptions. Does nothing where the source has
/// no folder.
void read_material_files(const Source& source, const std::vector<std::string_view>& libraries,
                         const std::vector<std::string_view>& names, Soup& soup);

}  // namespace ridgecraft::mesh
