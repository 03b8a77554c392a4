// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies as files.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "solid/body.hpp"

namespace ridgecraft::solid {

/// OBJ with one object per body, named hull_1, hull_2, ...; every bit of the coordinates is kept. `comment`
/// becomes the first line.
[[nodiscard]] std::string write_obj(const std::vector<Body>& bodies, std::string_view comment);

/// URDF: one link named `name` with a collision element per body, whose meshes are `mesh_files` (one per
/// body, convex; paths as the reader of the URDF resolves them), and a visual element `visual_file`. Lengths
/// of the meshes are multiplied by `metres_per_unit`; mass and inertia are those of the bodies at `density`
/// kg/m^3, as if they shared no space.
struct UrdfOptions {
  std::string name;
  std::string comment;
  std::string visual_file;
  std::vector<std::string> mesh_files;
  double metres_per_unit = 0.001;
  double density = 1000.0;
};
[[nodiscard]] std::string write_urdf(const std::vector<Body>& bodies, const UrdfOptions& options);

}  // namespace ridgecraft::solid
