// SPDX-License-Identifier: GPL-3.0-or-later
// From a model's frame back to the numbers of its file, for whoever writes meshes.
#pragma once

#include <vector>

#include "base/vector.hpp"
#include "mesh/model/model.hpp"
#include "mesh/model/surface.hpp"

namespace ridgecraft::mesh {

/// Points in the frame of a model's surface become points of its file: repair divides extreme coordinates by
/// `file_scale` (Model::file_scale). Exact, since that is a power of two.
void to_file_numbers(std::vector<Vec3>& points, double file_scale);

/// The model's surface as its file has it.
[[nodiscard]] Surface surface_in_file_numbers(const Model& model);

}  // namespace ridgecraft::mesh
