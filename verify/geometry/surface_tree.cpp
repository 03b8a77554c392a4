// SPDX-License-Identifier: GPL-3.0-or-later
#include "verify/geometry/surface_tree.hpp"

#include <algorithm>
#include <cmath>

#include "base/segment.hpp"

namespace ridgecraft::verify {
namespace {

double square(Vec3 a) {
  return dot(a, a);
}

Vec3 centre_of(const Triangle3& t) {
  return (t[0] + t[1] + t[2]) / 3.0;
}

Box3 box_of(const Triangle3& t) {
  Box3 box;
  std::for_each(t.begin(), t.end(), [&](Vec3 p) { box.add(p); });
  return box;
}

}  // namespace

Vec3 nearest_on(const Triangle3& t, Vec3 p) {
  const Vec3 normal = cross(t[1] - t[0], t[2] - t[0]);
  bool inside = square(normal) > 0.0;
  for (std::size_t k = 0; k < 3 && inside; ++k) {
    inside = dot(cross(normal, t[(k + 1) % 3] - t[k]), p - t[k]) >= 0.0;
  }
  if (inside) {
    return p - (dot(p - t[0], normal) / square(normal)) * normal;
  }
  Vec3 best = nearest_on_segment(p, t[0], t[1]);
  for (std::size_t k = 1; k < 3; ++k) {
    const Vec3 other = nearest_on_segment(p, t[k], t[(k + 1) % 3]);
    best = square(p - other) < square(p - best) ? other : best;
  }
  return best;
}

SurfaceTree::SurfaceTree(const std::vector<Triangle3>& triangles)
    : tree_(
          triangles.size(), [&](std::uint32_t i) { return box_of(triangles[i]); },
          [&](std::uint32_t i) { return centre_of(triangles[i]); }) {
  triangles_.reserve(triangles.size());
  for (const std::uint32_t i : tree_.order()) {
    triangles_.push_back(triangles[i]);
  }
}

SurfaceTree::Place SurfaceTree::nearest(Vec3 p, double enough, const Place& guess) const {
  struct Found {
    Place place;
    double distance;  ///< squared
  };
  const Vec3 first = nearest_on(triangles_[guess.triangle], p);
  const double enough_square = enough * enough;
  return tree_
      .nearest_first(
          p, Found{{first, guess.triangle}, square(p - first)},
          [enough_square](const Found& found, std::uint32_t, double distance) {
            return found.distance > enough_square && distance < found.distance;
          },
          [&](Found& found, std::uint32_t i) {
            const Vec3 candidate = nearest_on(triangles_[i], p);
            if (const double distance = square(p - candidate); distance < found.distance) {
              found = {{candidate, i}, distance};
            }
          })
      .place;
}

}  // namespace ridgecraft::verify
