// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/reading/gltf/scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace ridgecraft::mesh {
namespace {

/// Four by four numbers, column after column.
Affine affine_of_matrix(const GltfObject& node, const std::vector<double>& m) {
  // Written by programs that count in floats.
  constexpr double rounding = 1e-4;
  if (std::abs(m[3]) > rounding || std::abs(m[7]) > rounding || std::abs(m[11]) > rounding ||
      std::abs(m[15] - 1.0) > rounding) {
    node.refuse("\"matrix\" doesn't keep straight things straight: its last row isn't 0 0 0 1");
  }
  return {{Vec3{m[0], m[4], m[8]}, Vec3{m[1], m[5], m[9]}, Vec3{m[2], m[6], m[10]}}, {m[12], m[13], m[14]}};
}

/// The turn of a quaternion x, y, z, w of any length but 0.
Affine turn_of(const GltfObject& node, const std::vector<double>& q) {
  const double norm = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
  if (!(norm > 0.0) || !std::isfinite(norm)) {
    node.refuse("\"rotation\" is no turn: its length is 0 or not finite");
  }
  const double s = 2.0 / norm;
  const auto [x, y, z, w] = std::array{q[0], q[1], q[2], q[3]};
  return {{Vec3{1.0 - s * (y * y + z * z), s * (x * y - z * w), s * (x * z + y * w)},
           Vec3{s * (x * y + z * w), 1.0 - s * (x * x + z * z), s * (y * z - x * w)},
           Vec3{s * (x * z - y * w), s * (y * z + x * w), 1.0 - s * (x * x + y * y)}},
          {}};
}

Affine place_in_parent(const GltfObject& node) {
  if (const auto matrix = node.numbers("matrix", 16)) {
    return affine_of_matrix(node, *matrix);
  }
  Affine place;
  if (const auto q = node.numbers("rotation", 4)) {
    place = turn_of(node, *q);
  }
  if (const auto scale = node.numbers("scale", 3)) {
    for (Vec3& row : place.rows) {
      row = {row.x * (*scale)[0], row.y * (*scale)[1], row.z * (*scale)[2]};
    }
  }
  if (const auto shift = node.numbers("translation", 3)) {
    place.shift = {(*shift)[0], (*shift)[1], (*shift)[2]};
  }
  return place;
}

/// Nodes that no other one names as its child.
std::vector<std::uint64_t> all_roots(const GltfDocument& document) {
  const std::size_t count = document.root().size("nodes");
  std::vector<bool> is_child(count, false);
  for (std::size_t i = 0; i < count; ++i) {
    for (const std::uint64_t child : document.root().element("nodes", i).wholes("children")) {
      if (child < count) {
        is_child[child] = true;
      }
    }
  }
  std::vector<std::uint64_t> roots;
  for (std::size_t i = 0; i < count; ++i) {
    if (!is_child[i]) {
      roots.push_back(i);
    }
  }
  if (roots.empty() && count > 0) {
    document.root().refuse("each of its nodes is in another one");
  }
  return roots;
}

std::vector<std::uint64_t> roots_of(const GltfDocument& document) {
  const GltfObject& root = document.root();
  if (const auto scene = root.whole("scene")) {
    return document.element("scenes", *scene, root).wholes("nodes");
  }
  return root.size("scenes") > 0 ? root.element("scenes", 0).wholes("nodes") : all_roots(document);
}

}  // namespace

GltfScene read_scene(const GltfDocument& document) {
  GltfScene scene;
  scene.places.resize(document.root().size("nodes"));
  struct Open {
    std::uint64_t node;
    Affine parent;
  };
  std::vector<Open> open;
  const auto push = [&](const std::vector<std::uint64_t>& nodes, const Affine& parent) {
    std::for_each(nodes.rbegin(), nodes.rend(), [&](std::uint64_t node) { open.push_back({node, parent}); });
  };
  push(roots_of(document), {});
  while (!open.empty()) {
    const auto [number, parent] = open.back();
    open.pop_back();
    const GltfObject node = document.element("nodes", number, document.root());
    if (scene.places[number]) {
      node.refuse("it is in two other nodes, or in itself");
    }
    const Affine place = parent * place_in_parent(node);
    scene.places[number] = place;
    if (const auto mesh = node.whole("mesh")) {
      scene.instances.push_back({number, *mesh, place, node.whole("skin")});
    }
    push(node.wholes("children"), place);
    document.source().context.check();
  }
  return scene;
}

}  // namespace ridgecraft::mesh
