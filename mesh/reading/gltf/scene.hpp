// SPDX-License-Identifier: GPL-3.0-or-later
// The nodes of a glTF scene: which mesh stands where.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "mesh/reading/affine.hpp"
#include "mesh/reading/gltf/document.hpp"

namespace ridgecraft::mesh {

struct GltfInstance {
  std::uint64_t node;
  std::uint64_t mesh;
  Affine place;                       ///< from the mesh's numbers to the scene's
  std::optional<std::uint64_t> skin;  ///< then joints place the points, not the node
};

struct GltfScene {
  /// In the order in which the tree of nodes is walked through, children after their parents.
  std::vector<GltfInstance> instances;
  /// Per node of the file: where it stands; nothing for those that aren't in the scene.
  std::vector<std::optional<Affine>> places;
};

/// The scene that the file says is shown; the first where it says nothing, all nodes where it has none.
/// Refuses nodes that hold each other or have two parents.
[[nodiscard]] GltfScene read_scene(const GltfDocument& document);

}  // namespace ridgecraft::mesh
