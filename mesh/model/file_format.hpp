// SPDX-License-Identifier: GPL-3.0-or-later
// The formats of model files, in one table.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace ridgecraft::mesh {

enum class FileFormat {
  obj,
  stl_ascii,
  stl_binary,
  ply_ascii,
  ply_binary,
  off,
  gltf,
  glb,
  threemf,
  pdo,
  // by a program beside this one (import/, mesh/reading/imported)
  dae,
  fbx,
  max3ds,
  blend
};

/// "OBJ", "STL", "PLY", "OFF", "glTF" and so on.
[[nodiscard]] std::string_view format_name(FileFormat format);

/// "OBJ", "STL" and so on: each name once. They are the suffixes of their files, too, in letters of either
/// case.
[[nodiscard]] std::vector<std::string> format_names();

/// The number that the format itself gives to the first point of a file: OBJ counts from 1, others from 0.
[[nodiscard]] std::uint32_t first_point_number(FileFormat format);

/// True where the format itself gives one point several times, so that joining equal points is part of
/// reading: facets of STL have corners of their own, glTF divides points where normals or pictures meet.
[[nodiscard]] bool repeats_points(FileFormat format);

}  // namespace ridgecraft::mesh
