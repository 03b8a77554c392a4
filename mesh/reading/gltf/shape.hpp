// SPDX-License-Identifier: GPL-3.0-or-later
// The shapes in a glTF file: accessors, the nodes of the scene, and where the points of each mesh are.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/vector.hpp"
#include "mesh/reading/gltf/document.hpp"
#include "mesh/reading/source.hpp"

namespace ridgecraft::mesh {

// Accessors of glTF: lists of numbers or vectors in the bytes of a file.

/// Values of one accessor, element after element.
struct GltfValues {
  std::size_t components = 1;  ///< of an element
  std::vector<double> numbers;

  [[nodiscard]] std::size_t count() const { return numbers.size() / components; }
  [[nodiscard]] std::span<const double> operator[](std::size_t i) const {
    return {numbers.data() + i * components, components};
  }
};

/// Reads accessors, each once. Whatever an accessor says is held against the bytes that there are.
class GltfAccessors {
 public:
  explicit GltfAccessors(GltfDocument& document) : document_(document) {}

  /// The values of accessor i, whose elements have so many components (one of two numbers of them). Integers
  /// that the file calls normalized become 0 to 1, or -1 to 1. `user` names the accessor.
  [[nodiscard]] const GltfValues& values(std::uint64_t i, const GltfObject& user,
                                         std::span<const std::size_t> components);
  /// Whole numbers for the corners of faces, each below `limit`.
  [[nodiscard]] std::vector<std::uint32_t> indices(std::uint64_t i, const GltfObject& user,
                                                   std::size_t limit) const;

  /// What an accessor holds whose values are compressed; the last counts.
  void put(std::uint64_t i, GltfValues values) { read_.insert_or_assign(i, std::move(values)); }
  void put_indices(std::uint64_t i, std::vector<std::uint32_t> indices) {
    indices_.insert_or_assign(i, std::move(indices));
  }

 private:
  GltfDocument& document_;
  std::map<std::uint64_t, GltfValues> read_;
  std::map<std::uint64_t, std::vector<std::uint32_t>> indices_;
  std::uint64_t values_read_ = 0;
};

// The nodes of a glTF scene: which mesh stands where.

struct GltfInstance {
  std::uint64_t node;
  std::uint64_t mesh;
  Affine place;                       ///< from the mesh's numbers to the scene's
  std::optional<std::uint64_t> skin;  ///< then joints place the points, not the node
};

/// Where copies of an object are (EXT_mesh_gpu_instancing): from its numbers to its node's.
[[nodiscard]] std::vector<Affine> copies_of(GltfAccessors& accessors, const GltfObject& instancing);

struct GltfScene {
  /// In the order in which the tree of nodes is walked through, children after their parents.
  std::vector<GltfInstance> instances;
  /// Per node of the file: where it stands; nothing for those that aren't in the scene.
  std::vector<std::optional<Affine>> places;
};

/// The scene that the file says is shown; the first where it says nothing, all nodes where it has none.
/// Refuses nodes that hold each other or have two parents.
[[nodiscard]] GltfScene read_scene(const GltfDocument& document);

// Where the points of a mesh are: shape keys and joints at rest, then its place in the scene.

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
