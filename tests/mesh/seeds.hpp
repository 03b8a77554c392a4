// SPDX-License-Identifier: GPL-3.0-or-later
// Small files of many formats, to be read and to be damaged.
#pragma once

#include <string>

#include "mesh/file_writers.hpp"

namespace ridgecraft::test {

// Small files of glTF and 3MF that use most of what the readers know, to be read and to be damaged.

/// A PNG picture as far as it is looked at.
[[nodiscard]] std::string tiny_png();

/// A tetrahedron, two nodes with it (one of them mirrored), strips, colours, a picture, joints and a shape
/// key.
[[nodiscard]] std::string rich_glb();
/// The same as text.
[[nodiscard]] std::string rich_gltf();
/// The root part of a 3MF file with all kinds of paint, components and a mirrored item.
[[nodiscard]] std::string rich_model();
/// The parts that it names.
[[nodiscard]] ZipFiles rich_parts();
/// The whole file.
[[nodiscard]] std::string rich_3mf();

// One box, 2 wide, 1 deep and 3 high (z is up), in formats that ridgecraft-import reads.

/// FBX as text: in inches, an object "tower" of the orange material "stone".
[[nodiscard]] std::string fbx_tower();
/// COLLADA, the same in centimetres.
[[nodiscard]] std::string dae_tower();
/// 3DS, the same in triangles; the object's name is lost on the way through Assimp.
[[nodiscard]] std::string max3ds_tower();

}  // namespace ridgecraft::test
