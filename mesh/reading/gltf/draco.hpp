// SPDX-License-Identifier: GPL-3.0-or-later
// Primitives of glTF that Draco packs (KHR_draco_mesh_compression), by libdraco. Where the program was built
// without it they are refused.
#pragma once

#include "mesh/reading/gltf/shape.hpp"

namespace ridgecraft::mesh {

/// Unpacks what the Draco extension of a primitive holds: the values of its attributes' accessors, and its
/// corners.
void unpack_draco(GltfDocument& document, GltfAccessors& accessors, const GltfObject& primitive,
                  const GltfObject& extension);

}  // namespace ridgecraft::mesh
