// SPDX-License-Identifier: GPL-3.0-or-later
// What the properties of a PLY element mean to us, by the names that programs give them.
#pragma once

#include <algorithm>
#include <vector>

#include "mesh/reading/ply_header.hpp"

namespace ridgecraft::mesh {

enum class PlyKind { vertex, face, edge };

enum class PlyRole {
  skipped,
  // Of a point.
  x,
  y,
  z,
  u,
  v,
  // Of a point or a face.
  red,
  green,
  blue,
  // Of a face.
  indices,
  texture_list,
  texture_number,
  // Of an edge: the numbers of two points.
  first_end,
  second_end,
};

using PlyRoles = std::vector<PlyRole>;

/// The role of each property of the element. Of two properties of one meaning the first has it; what isn't
/// known, or names points by numbers that aren't integers where an edge does, is skipped.
[[nodiscard]] PlyRoles ply_roles(const PlyElement& element, PlyKind kind);

[[nodiscard]] inline bool has(const PlyRoles& roles, PlyRole role) {
  return std::find(roles.begin(), roles.end(), role) != roles.end();
}

}  // namespace ridgecraft::mesh
