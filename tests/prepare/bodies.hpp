// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies for tests of one skin, and what becomes of them.
#pragma once

#include <cstdint>
#include <vector>

#include "prepare/skin/skin.hpp"
#include "support/soups.hpp"

namespace ridgecraft::test {

struct Shape {
  std::vector<Vec3> points;
  std::vector<std::vector<std::uint32_t>> faces;

  void add(const Shape& other) {
    faces = both(faces, shifted(other.faces, static_cast<std::uint32_t>(points.size())));
    points = both(points, other.points);
  }
};

inline Shape box(Vec3 low, Vec3 high) {
  return {box_points(low, high), box_faces};
}

inline mesh::Model model_of_shape(const Shape& shape) {
  return repaired(soup(shape.points, shape.faces));
}

struct United {
  mesh::Model model;
  prepare::SkinReport report;
};
inline United united(const Shape& shape) {
  United result{model_of_shape(shape), {}};
  result.report = prepare::unite_bodies(result.model, {});
  check_invariants(result.model.surface);
  REQUIRE(result.model.polygon.size() == result.model.surface.face_count());
  return result;
}

}  // namespace ridgecraft::test
