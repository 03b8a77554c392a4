// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/view/scene.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <boost/polygon/polygon.hpp>

#include "base/geometry.hpp"

namespace ridgecraft::export_ {
namespace planar = boost::polygon;

std::vector<std::vector<Vec2>> trapezoids(const std::vector<Vec2>& outline) {
  constexpr double grid_cells = 1e7;
  Box2 box;
  for (const Vec2 p : outline) {
    box.add(p);
  }
  if (box.empty()) {
    return {};
  }
  const double cell = std::max({box.size().x, box.size().y, 1e-300}) / grid_cells;
  std::vector<planar::point_data<int>> points;
  for (const Vec2 p : outline) {
    const Vec2 q = (p - box.low) / cell;
    points.emplace_back(static_cast<int>(std::lround(q.x)), static_cast<int>(std::lround(q.y)));
  }
  planar::polygon_data<int> polygon;
  polygon.set(points.begin(), points.end());
  planar::polygon_set_data<int> covered;
  covered.insert(polygon);
  std::vector<planar::polygon_data<int>> pieces;
  covered.get_trapezoids(pieces);
  std::vector<std::vector<Vec2>> result;
  for (const planar::polygon_data<int>& piece : pieces) {
    std::vector<Vec2>& corners = result.emplace_back();
    for (const auto& p : piece) {
      const Vec2 corner = box.low + cell * Vec2{static_cast<double>(p.x()), static_cast<double>(p.y())};
      if (corners.empty() || (corner != corners.front() && corner != corners.back())) {
        corners.push_back(corner);
      }
    }
    if (corners.size() < 3) {
      result.pop_back();
    } else if (doubled_area(corners) < 0.0) {
      std::reverse(corners.begin(), corners.end());
    }
  }
  return result;
}

namespace {

/// A face that is turned away from the eye's direction by less than this (as a sine) is edge-on: a line.
constexpr double edge_on_sine = 1e-3;

/// Components that are there as a whole and have no border.
std::vector<bool> closed_components(const Scene& scene) {
  const mesh::Surface& surface = *scene.surface;
  std::vector<bool> closed(surface.component_count(), true);
  for (const FaceId face : ids<FaceId>(surface.face_count())) {
    bool whole = scene.has(face);
    for (const unsigned k : {0U, 1U, 2U}) {
      whole = whole && surface.neighbor(mesh::corner(face, k)).valid();
    }
    if (!whole) {
      closed[surface.component(face).value()] = false;
    }
  }
  return closed;
}

}  // namespace

std::vector<SeenFace> seen_faces(const Scene& scene, const Camera& camera) {
  const mesh::Surface& surface = *scene.surface;
  const std::vector<bool> closed = closed_components(scene);
  std::vector<SeenFace> faces;
  for (const FaceId face : ids<FaceId>(surface.face_count())) {
    const Vec3 normal = surface.normal(face);
    const double facing = dot(normal, camera.toward);
    if (!scene.has(face) || std::abs(facing) < edge_on_sine ||
        (facing < 0.0 && closed[surface.component(face).value()])) {
      continue;
    }
    SeenFace seen;
    seen.face = face;
    seen.inside = facing < 0.0;
    const auto vertices = surface.vertices(face);
    for (std::size_t k = 0; k < 3; ++k) {
      seen.corners[k] = camera(surface.point(vertices[k]));
    }
    if (seen.inside) {
      std::swap(seen.corners[1], seen.corners[2]);
    }
    // The normal is (a, b, c) in the eye's frame: a x + b y + c depth is the same for all points of the face.
    const double a = dot(normal, camera.right) / facing;
    const double b = dot(normal, camera.up) / facing;
    const Vec3 first = surface.point(vertices[0]);
    const Vec2 at = camera(first);
    seen.depth_plane = {-a, -b, camera.depth(first) + a * at.x + b * at.y};
    faces.push_back(seen);
  }
  return faces;
}

Box2 seen_box(const Scene& scene, const Camera& camera) {
  const mesh::Surface& surface = *scene.surface;
  Box2 box;
  for (const FaceId face : ids<FaceId>(surface.face_count())) {
    if (scene.has(face)) {
      for (const VertexId v : surface.vertices(face)) {
        box.add(camera(surface.point(v)));
      }
    }
  }
  return box;
}

}  // namespace ridgecraft::export_
