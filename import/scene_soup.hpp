// SPDX-License-Identifier: GPL-3.0-or-later
// What Assimp found in a file, as polygons.
#pragma once

#include <string>

struct aiScene;

namespace ridgecraft::import {

/// The stream (mesh/reading/imported/stream.hpp) of all meshes of a scene where its nodes stand. `format` is
/// the name of the file's format: formats tell unit and up axis in ways of their own. Throws
/// std::runtime_error for what would become too large.
[[nodiscard]] std::string soup_stream(const aiScene& scene, const std::string& format);

}  // namespace ridgecraft::import
