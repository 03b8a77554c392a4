// SPDX-License-Identifier: GPL-3.0-or-later
// Where the points of a mesh are: shape keys and joints at rest, then its place in the scene.
#pragma once

#include <cstdint>
#include <vector>

#include "base/vector.hpp"
#include "mesh/reading/gltf/accessor.hpp"
#include "mesh/reading/gltf/scene.hpp"

namespace ridgecraft::mesh {

/// How far each shape key of a mesh is pulled at rest: what the node says, or else the mesh.
[[nodiscard]] std::vector<double> resting_weights(const GltfObject& node, const GltfObject& mesh);

/// What joints do to the points of a mesh.
struct GltfSkin {
  std::vector<Affine> joints;  ///< from the mesh's numbers to the scene's
};

/// Joints that aren't in the scene stand where the scene's origin is.
[[nodiscard]] GltfSkin read_skin(GltfDocument& document, GltfAccessors& accessors, const GltfScene& scene,
                                 std::uint64_t skin, const GltfObject& user);

/// The points of a primitive in the scene, finite; else refused. `skin` is null for what no joint moves.
[[nodiscard]] std::vector<Vec3> points_in_scene(GltfAccessors& accessors, const GltfObject& primitive,
                                                const std::vector<double>& weights, const Affine& place,
                                                const GltfSkin* skin);

}  // namespace ridgecraft::mesh
