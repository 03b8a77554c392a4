// SPDX-License-Identifier: GPL-3.0-or-later
// Small files of glTF and 3MF that use most of what the readers know, to be read and to be damaged.
#pragma once

#include <string>

#include "package_writer.hpp"

namespace ridgecraft::test {

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

}  // namespace ridgecraft::test
