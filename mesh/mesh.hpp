// SPDX-License-Identifier: GPL-3.0-or-later
// What a model is: reading and repair. Read this header first.
//
//   file --read--> Model (repaired, in the file's unit)
//
// Errors are ridgecraft::Error of kinds unreadable_input, unusable_mesh, interrupted.
#pragma once

#include <filesystem>

#include "base/context.hpp"
#include "mesh/model/model.hpp"
#include "mesh/model/read_options.hpp"

namespace ridgecraft::mesh {

/// Reads OBJ, STL, PLY or OFF (content decides, the suffix only helps) and repairs it: points joined,
/// polygons triangulated, duplicates dropped, faces oriented, edges and vertices made manifold. Every change
/// is counted in Model::repairs. Cost O(n log n). Throws unreadable_input or unusable_mesh with a sentence
/// that names the file.
[[nodiscard]] Model read(const std::filesystem::path& file, const ReadOptions& options,
                         const Context& context);

}  // namespace ridgecraft::mesh
