// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/shapes.hpp"

#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <utility>

namespace ridgecraft::test {
namespace {

using Faces = std::vector<std::array<VertexId, 3>>;

/// Collects faces by integer lattice points, so that equal points are one vertex.
class Lattice {
 public:
  explicit Lattice(double scale) : scale_(scale) {}
  VertexId vertex(std::array<int, 3> at) {
    const auto [found, fresh] = number_.try_emplace(at, VertexId(points_.size()));
    if (fresh) {
      points_.push_back({scale_ * at[0], scale_ * at[1], scale_ * at[2]});
    }
    return found->second;
  }
  void triangle(std::array<int, 3> a, std::array<int, 3> b, std::array<int, 3> c) {
    const VertexId va = vertex(a);
    const VertexId vb = vertex(b);
    faces_.push_back({va, vb, vertex(c)});
  }
  mesh::Surface surface() && { return {std::move(points_), std::move(faces_)}; }

 private:
  double scale_;
  std::map<std::array<int, 3>, VertexId> number_;
  std::vector<Vec3> points_;
  Faces faces_;
};

}  // namespace

mesh::Surface cube() {
  return voxels({{0, 0, 0}});
}

mesh::Surface tetrahedron() {
  return {{{0, 0, 0}, {1, 1, 0}, {1, 0, 1}, {0, 1, 1}},
          {{VertexId(0), VertexId(1), VertexId(2)},
           {VertexId(0), VertexId(3), VertexId(1)},
           {VertexId(0), VertexId(2), VertexId(3)},
           {VertexId(1), VertexId(3), VertexId(2)}}};
}

mesh::Surface voxels(const std::vector<std::array<int, 3>>& cells, int k) {
  const std::set<std::array<int, 3>> solid(cells.begin(), cells.end());
  Lattice lattice(1.0 / k);
  for (const auto& cell : cells) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (const int side : {0, 1}) {
        std::array<int, 3> beyond = cell;
        beyond[axis] += side == 0 ? -1 : 1;
        if (solid.contains(beyond)) {
          continue;
        }
        // u x v points along the axis; swapped on the low side so that the normal points outward.
        std::size_t u = (axis + 1) % 3;
        std::size_t v = (axis + 2) % 3;
        if (side == 0) {
          std::swap(u, v);
        }
        for (int i = 0; i < k; ++i) {
          for (int j = 0; j < k; ++j) {
            const auto at = [&](int di, int dj) {
              std::array<int, 3> p{k * cell[0], k * cell[1], k * cell[2]};
              p[axis] += k * side;
              p[u] += i + di;
              p[v] += j + dj;
              return p;
            };
            lattice.triangle(at(0, 0), at(1, 0), at(1, 1));
            lattice.triangle(at(0, 0), at(1, 1), at(0, 1));
          }
        }
      }
    }
  }
  return std::move(lattice).surface();
}

mesh::Surface revolve(const std::vector<Vec2>& profile, int steps) {
  std::vector<Vec3> points;
  Faces faces;
  const bool closed = profile.size() > 2 && profile.front() == profile.back();
  const std::size_t rings = closed ? profile.size() - 1 : profile.size();
  std::vector<std::vector<VertexId>> ring(rings);
  for (std::size_t i = 0; i < rings; ++i) {
    const bool pole = profile[i].x == 0.0;
    for (int s = 0; s < steps; ++s) {
      if (pole && s > 0) {
        ring[i].push_back(ring[i].front());
        continue;
      }
      const double angle = 2.0 * std::numbers::pi * s / steps;
      ring[i].push_back(VertexId(points.size()));
      points.push_back({profile[i].x * std::cos(angle), profile[i].x * std::sin(angle), profile[i].y});
    }
  }
  for (std::size_t i = 0; i + 1 < profile.size(); ++i) {
    const auto& low = ring[i];
    const auto& high = ring[(i + 1) % rings];
    for (std::size_t s = 0; s < static_cast<std::size_t>(steps); ++s) {
      const std::size_t t = (s + 1) % static_cast<std::size_t>(steps);
      if (low[s] != low[t]) {
        faces.push_back({low[s], low[t], high[t]});
      }
      if (high[s] != high[t]) {
        faces.push_back({low[s], high[t], high[s]});
      }
    }
  }
  return {std::move(points), std::move(faces)};
}

mesh::Surface sphere(int longitudes, int latitudes) {
  std::vector<Vec2> profile;
  for (int i = 0; i <= latitudes; ++i) {
    const double angle = std::numbers::pi * i / latitudes;
    const bool pole = i == 0 || i == latitudes;
    profile.push_back({pole ? 0.0 : std::sin(angle), -std::cos(angle)});
  }
  return revolve(profile, longitudes);
}

mesh::Surface scaled(const mesh::Surface& surface, double factor) {
  std::vector<Vec3> points;
  for (const Vec3 p : surface.points()) {
    points.push_back(factor * p);
  }
  std::vector<std::array<VertexId, 3>> faces;
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    faces.push_back(surface.vertices(f));
  }
  return {std::move(points), std::move(faces)};
}

}  // namespace ridgecraft::test
