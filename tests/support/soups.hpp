// SPDX-License-Identifier: GPL-3.0-or-later
// Soups made by hand, and what is asked of the surfaces that repair makes of them.
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <vector>

#include <catch2/catch.hpp>

#include "mesh/repair/repair.hpp"

namespace ridgecraft::test {

inline mesh::Soup soup(std::vector<Vec3> points, const std::vector<std::vector<std::uint32_t>>& polygons) {
  mesh::Soup s;
  s.points = std::move(points);
  for (const auto& polygon : polygons) {
    s.corner_point.insert(s.corner_point.end(), polygon.begin(), polygon.end());
    s.first_corner.push_back(static_cast<std::uint32_t>(s.corner_point.size()));
  }
  return s;
}

inline mesh::Model repaired(mesh::Soup s, bool collapse = true) {
  mesh::ReadOptions options;
  options.collapse_flat_faces = collapse;
  return mesh::repair(std::move(s), options, {});
}

/// Surface's invariants once more, by brute force over sets and maps.
inline void check_invariants(const mesh::Surface& surface) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> directed;
  std::map<std::uint32_t, std::vector<std::pair<std::uint32_t, std::uint32_t>>> links;
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    const auto v = surface.vertices(f);
    REQUIRE((v[0] != v[1] && v[1] != v[2] && v[2] != v[0]));
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = v[k].value();
      const std::uint32_t b = v[(k + 1) % 3].value();
      REQUIRE(++directed[std::pair(a, b)] == 1);
      links[a].emplace_back(b, v[(k + 2) % 3].value());
    }
  }
  REQUIRE(links.size() == surface.vertex_count());
  for (auto& [vertex, link] : links) {
    std::set<std::uint32_t> reached{link[0].first, link[0].second};
    for (bool grew = true; grew;) {
      grew = false;
      for (const auto& [a, b] : link) {
        if (reached.contains(a) != reached.contains(b)) {
          reached.insert(a);
          reached.insert(b);
          grew = true;
        }
      }
    }
    for (const auto& [a, b] : link) {
      REQUIRE(reached.contains(a));
    }
  }
}

inline double volume(const mesh::Surface& surface) {
  double sum = 0.0;
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    const auto [a, b, c] = surface.vertices(f);
    sum += dot(surface.point(a), cross(surface.point(b), surface.point(c))) / 6.0;
  }
  return sum;
}

inline double area(const mesh::Surface& surface) {
  double sum = 0.0;
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    sum += surface.area(f);
  }
  return sum;
}

inline std::size_t border_edges(const mesh::Surface& surface) {
  std::size_t count = 0;
  for (const EdgeId e : ids<EdgeId>(surface.edge_count())) {
    count += surface.is_border(e) ? 1U : 0U;
  }
  return count;
}

/// Vertices - edges + faces.
inline int euler(const mesh::Surface& surface) {
  return static_cast<int>(surface.vertex_count()) - static_cast<int>(surface.edge_count()) +
         static_cast<int>(surface.face_count());
}

/// A soup of the surface's faces.
inline mesh::Soup soup_of(const mesh::Surface& surface) {
  std::vector<std::vector<std::uint32_t>> faces;
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    const auto [a, b, c] = surface.vertices(f);
    faces.push_back({a.value(), b.value(), c.value()});
  }
  return soup({surface.points().begin(), surface.points().end()}, faces);
}

inline const std::vector<Vec3> tetra{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
inline const std::vector<std::vector<std::uint32_t>> tetra_faces{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};

/// The points of a box, bottom counterclockwise from above, then top.
inline std::vector<Vec3> box_points(Vec3 low, Vec3 high) {
  return {{low.x, low.y, low.z},  {high.x, low.y, low.z},  {high.x, high.y, low.z},  {low.x, high.y, low.z},
          {low.x, low.y, high.z}, {high.x, low.y, high.z}, {high.x, high.y, high.z}, {low.x, high.y, high.z}};
}
inline const std::vector<std::vector<std::uint32_t>> box_faces{{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                                               {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};

inline std::vector<std::vector<std::uint32_t>> shifted(std::vector<std::vector<std::uint32_t>> faces,
                                                       std::uint32_t by) {
  for (auto& face : faces) {
    for (auto& v : face) {
      v += by;
    }
  }
  return faces;
}

template <class T>
std::vector<T> both(std::vector<T> a, const std::vector<T>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

}  // namespace ridgecraft::test
