// SPDX-License-Identifier: GPL-3.0-or-later
// What CGAL made as a body. Private to solid/: CGAL's meshes stay in the files that call it.
#pragma once

#include <array>
#include <cstdint>

#include "solid/body.hpp"

namespace ridgecraft::solid {

/// A CGAL::Surface_mesh of triangles without removed elements: its points and triangles in their order. O(n).
template <class SurfaceMesh>
[[nodiscard]] Body body_of(const SurfaceMesh& mesh) {
  Body body;
  for (const auto v : mesh.vertices()) {
    const auto& p = mesh.point(v);
    body.points.push_back({p.x(), p.y(), p.z()});
  }
  for (const auto f : mesh.faces()) {
    std::array<std::uint32_t, 3> triangle{};
    auto h = mesh.halfedge(f);
    for (std::uint32_t& corner : triangle) {
      corner = static_cast<std::uint32_t>(mesh.target(h));
      h = mesh.next(h);
    }
    body.triangles.push_back(triangle);
  }
  return body;
}

}  // namespace ridgecraft::solid
