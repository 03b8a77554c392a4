// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/view/scene.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <boost/polygon/polygon.hpp>

#include "base/geometry.hpp"
#include "base/no_index.hpp"

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

namespace {

/// The pixels whose middles lie between two places along a side.
struct PixelRange {
  std::size_t from = 0;
  std::size_t to = 0;
};
PixelRange pixels_between(double low, double high, double start, double pixel, std::size_t count) {
  const auto clamped = [&](double at) {
    return static_cast<std::size_t>(std::clamp(at, 0.0, static_cast<double>(count)));
  };
  return {clamped(std::floor((low - start) / pixel - 0.5)), clamped(std::ceil((high - start) / pixel + 0.5))};
}

}  // namespace

CoarseView look_coarsely(const Scene& scene, const Camera& camera, std::size_t across) {
  CoarseView view;
  const Box2 box = seen_box(scene, camera);
  const double size = std::max(box.size().x, box.size().y);
  if (box.empty() || !(size > 0.0)) {
    return view;
  }
  view.pixel = size / static_cast<double>(across);
  view.low = box.low;
  const auto count = [&](double extent) {
    return std::max<std::size_t>(1, static_cast<std::size_t>(std::ceil(extent / view.pixel)));
  };
  view.columns = count(box.size().x);
  view.rows = count(box.size().y);
  view.face.resize(view.columns * view.rows);
  std::vector<double> depth(view.face.size(), -INFINITY);
  for (const SeenFace& face : seen_faces(scene, camera)) {
    const Box2 own = face.box();
    const PixelRange x = pixels_between(own.low.x, own.high.x, view.low.x, view.pixel, view.columns);
    const PixelRange y = pixels_between(own.low.y, own.high.y, view.low.y, view.pixel, view.rows);
    const auto& [a, b, c] = face.corners;
    for (std::size_t row = y.from; row < y.to; ++row) {
      for (std::size_t column = x.from; column < x.to; ++column) {
        const std::size_t i = row * view.columns + column;
        const Vec2 p = view.centre(i);
        if (cross(b - a, p - a) >= 0.0 && cross(c - b, p - b) >= 0.0 && cross(a - c, p - c) >= 0.0 &&
            face.depth_at(p) > depth[i]) {
          depth[i] = face.depth_at(p);
          view.face[i] = face.face;
        }
      }
    }
  }
  return view;
}

std::vector<Anchor> find_anchors(const CoarseView& view, const IdVector<FaceId, std::uint32_t>& thing,
                                 std::size_t count) {
  const auto thing_at = [&](std::size_t i) { return view.face[i].valid() ? thing[view.face[i]] : no_index; };
  // Distances from what is another thing, in pixels, in two sweeps (Borgefors: Distance transformations in
  // digital images, 1986).
  constexpr double straight = 1.0;
  constexpr double oblique = 1.4142135623730951;
  std::vector<double> room(view.face.size(), 0.0);
  const auto sweep = [&](bool forward) {
    for (std::size_t n = 0; n < room.size(); ++n) {
      const std::size_t i = forward ? n : room.size() - 1 - n;
      const auto column = static_cast<std::ptrdiff_t>(i % view.columns);
      const auto row = static_cast<std::ptrdiff_t>(i / view.columns);
      const std::ptrdiff_t back = forward ? -1 : 1;
      double least = forward ? static_cast<double>(INFINITY) : room[i];
      const std::ptrdiff_t steps[4][2] = {{back, 0}, {0, back}, {-1, back}, {1, back}};
      for (const auto& step : steps) {
        const std::ptrdiff_t x = column + step[0];
        const std::ptrdiff_t y = row + step[1];
        const bool there = x >= 0 && y >= 0 && x < static_cast<std::ptrdiff_t>(view.columns) &&
                           y < static_cast<std::ptrdiff_t>(view.rows);
        const std::size_t other =
            there ? static_cast<std::size_t>(y) * view.columns + static_cast<std::size_t>(x) : 0;
        const double far = step[0] != 0 && step[1] != 0 ? oblique : straight;
        least = std::min(least, there && thing_at(other) == thing_at(i) ? room[other] + far : 0.5 * straight);
      }
      room[i] = least;
    }
  };
  sweep(true);
  sweep(false);
  std::vector<Anchor> anchors(count);
  for (std::size_t i = 0; i < room.size(); ++i) {
    if (const std::uint32_t t = thing_at(i); t != no_index) {
      Anchor& anchor = anchors[t];
      if (!anchor.seen || room[i] * view.pixel > anchor.room) {
        anchor = {true, view.centre(i), room[i] * view.pixel};
      }
    }
  }
  return anchors;
}

std::vector<Anchor> find_anchors_on_faces(const CoarseView& view, const Scene& scene,
                                          const IdVector<FaceId, std::uint32_t>& thing, std::size_t count) {
  std::size_t regions = 0;
  for (const FaceId face : view.face) {
    regions = std::max(regions, face.valid() ? std::size_t{scene.region[face]} + 1 : 0);
  }
  const std::vector<Anchor> of_region = find_anchors(view, scene.region, regions);
  std::vector<Anchor> anchors(count);
  for (const FaceId face : view.face) {
    if (face.valid()) {
      const Anchor& own = of_region[scene.region[face]];
      Anchor& best = anchors[thing[face]];
      best = !best.seen || own.room > best.room ? own : best;
    }
  }
  return anchors;
}

}  // namespace ridgecraft::export_
