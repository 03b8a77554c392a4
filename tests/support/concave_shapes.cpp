// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/concave_shapes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "base/context.hpp"
#include "base/random.hpp"
#include "support/shapes.hpp"

namespace ridgecraft::test {
namespace {

using Faces = std::vector<std::array<VertexId, 3>>;

Faces faces_of(const mesh::Surface& surface) {
  Faces faces;
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    faces.push_back(surface.vertices(f));
  }
  return faces;
}

}  // namespace

std::vector<Vec2> divided(const std::vector<Vec2>& profile, double step) {
  std::vector<Vec2> fine{profile.front()};
  for (std::size_t i = 0; i + 1 < profile.size(); ++i) {
    const Vec2 way = profile[i + 1] - profile[i];
    const int pieces = std::max(1, static_cast<int>(std::lround(length(way) / step)));
    for (int k = 1; k < pieces; ++k) {
      fine.push_back(profile[i] + (static_cast<double>(k) / pieces) * way);
    }
    fine.push_back(profile[i + 1]);
  }
  return fine;
}

mesh::Surface turned(const std::vector<Vec2>& profile, int steps) {
  return revolve(divided(profile), steps);
}

mesh::Surface sphere_chain(const std::vector<double>& heights, int steps) {
  std::vector<Vec2> profile;
  for (std::size_t i = 0; i < heights.size(); ++i) {
    // Polar angle from the lower crease (or pole) of this sphere to its upper one.
    const double low = i == 0 ? -1.0 : (heights[i - 1] - heights[i]) / 2.0;
    const double high = i + 1 == heights.size() ? 1.0 : (heights[i + 1] - heights[i]) / 2.0;
    const double from = std::asin(low);
    const double to = std::asin(high);
    const int pieces = std::max(2, static_cast<int>(std::lround((to - from) / 0.12)));
    for (int k = i == 0 ? 0 : 1; k <= pieces; ++k) {
      const double angle = from + (to - from) * k / pieces;
      const bool pole = (i == 0 && k == 0) || (i + 1 == heights.size() && k == pieces);
      profile.push_back({pole ? 0.0 : std::cos(angle), heights[i] + std::sin(angle)});
    }
  }
  return revolve(profile, steps);
}

mesh::Surface uneven_cup() {
  const mesh::Surface even =
      turned({{0, 0}, {1, 0}, {1, 1.97}, {0.97, 2}, {0.93, 2}, {0.9, 1.97}, {0.9, 0.1}, {0, 0.1}});
  return mapped(even, [](Vec3 p) {
    const double share = std::fmax(0.0, p.z - 1.0);
    return p + Vec3{0.0, 0.0, 0.05 * share * std::sin(3.0 * std::atan2(p.y, p.x))};
  });
}

mesh::Surface dumbbell() {
  std::vector<Vec2> profile;
  const double crease = std::asin(std::sqrt(1.0 - 0.25 * 0.25));
  const int pieces = 24;
  for (int k = 0; k <= pieces; ++k) {
    const double angle = -std::numbers::pi / 2 + (crease + std::numbers::pi / 2) * k / pieces;
    profile.push_back({k == 0 ? 0.0 : std::cos(angle), -2.0 + std::sin(angle)});
  }
  const std::size_t half = profile.size();
  const std::vector<Vec2> neck = divided({profile.back(), {profile.back().x, -profile.back().y}});
  profile.insert(profile.end(), neck.begin() + 1, neck.end() - 1);
  for (std::size_t i = half; i-- > 0;) {
    profile.push_back({profile[i].x, -profile[i].y});
  }
  return revolve(profile, 48);
}

mesh::Surface torus(double ring, double tube, int tube_steps, int ring_steps) {
  std::vector<Vec2> profile;
  for (int k = 0; k <= tube_steps; ++k) {
    const double angle = 2.0 * std::numbers::pi * (k % tube_steps) / tube_steps;
    profile.push_back({ring + tube * std::cos(angle), tube * std::sin(angle)});
  }
  return revolve(profile, ring_steps);
}

mesh::Surface star_shaped(const std::function<double(Vec3)>& radius, int longitudes, int latitudes) {
  return mapped(sphere(longitudes, latitudes), [&](Vec3 p) { return radius(normalized(p)) * normalized(p); });
}

std::vector<Vec3> icosahedron_corners() {
  std::vector<Vec3> corners;
  for (const double a : {-1.0, 1.0}) {
    for (const double b : {-std::numbers::phi, std::numbers::phi}) {
      corners.push_back(normalized(Vec3{0.0, a, b}));
      corners.push_back(normalized(Vec3{a, b, 0.0}));
      corners.push_back(normalized(Vec3{b, 0.0, a}));
    }
  }
  return corners;
}

mesh::Surface spiked_sphere(std::size_t spikes, double width, int longitudes, int latitudes) {
  const std::vector<Vec3> corners = icosahedron_corners();
  return star_shaped(
      [&](Vec3 p) {
        double rise = 0.0;
        for (std::size_t i = 0; i < spikes; ++i) {
          rise = std::max(rise, 0.9 * std::exp(-(1.0 - dot(p, corners[i])) / width));
        }
        return 1.0 + rise;
      },
      longitudes, latitudes);
}

mesh::Surface plate(double thickness, const std::function<bool(int, int)>& solid) {
  std::vector<std::array<int, 3>> cells;
  for (int i = 0; i < 10; ++i) {
    for (int j = 0; j < 10; ++j) {
      if (solid(i, j)) {
        cells.push_back({i, j, 0});
      }
    }
  }
  return mapped(voxels(cells, 2), [&](Vec3 p) { return Vec3{p.x, p.y, thickness * p.z}; });
}

mesh::Surface mapped(const mesh::Surface& surface, const std::function<Vec3(Vec3)>& map) {
  std::vector<Vec3> points;
  for (const Vec3 p : surface.points()) {
    points.push_back(map(p));
  }
  return {std::move(points), faces_of(surface)};
}

mesh::Surface together(const std::vector<mesh::Surface>& surfaces) {
  std::vector<Vec3> points;
  Faces faces;
  for (const mesh::Surface& s : surfaces) {
    const std::size_t first = points.size();
    points.insert(points.end(), s.points().begin(), s.points().end());
    for (auto face : faces_of(s)) {
      for (VertexId& v : face) {
        v = VertexId(first + v.value());
      }
      faces.push_back(face);
    }
  }
  return {std::move(points), std::move(faces)};
}

mesh::Surface shuffled(const mesh::Surface& surface, std::uint64_t seed,
                       std::vector<std::uint32_t>* face_from) {
  Random random(seed);
  const auto permutation = [&](std::size_t n) {
    std::vector<std::uint32_t> order(n);
    std::iota(order.begin(), order.end(), 0U);
    for (std::size_t i = n; i > 1; --i) {
      std::swap(order[i - 1], order[random.below(static_cast<std::uint32_t>(i))]);
    }
    return order;
  };
  const std::vector<std::uint32_t> new_vertex = permutation(surface.vertex_count());
  const std::vector<std::uint32_t> old_face = permutation(surface.face_count());
  std::vector<Vec3> points(surface.vertex_count());
  for (std::size_t v = 0; v < points.size(); ++v) {
    points[new_vertex[v]] = surface.points()[v];
  }
  Faces faces;
  for (const std::uint32_t f : old_face) {
    const auto old = surface.vertices(FaceId(f));
    const std::uint32_t turn = random.below(3);
    std::array<VertexId, 3> face;
    for (std::uint32_t k = 0; k < 3; ++k) {
      face[k] = VertexId(new_vertex[old[(k + turn) % 3].value()]);
    }
    faces.push_back(face);
  }
  if (face_from != nullptr) {
    *face_from = old_face;
  }
  return {std::move(points), std::move(faces)};
}

}  // namespace ridgecraft::test
