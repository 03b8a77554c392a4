// SPDX-License-Identifier: GPL-3.0-or-later
// The oracle of bench_unfold: what a net is, said with other words than the search's.
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include <CGAL/Exact_rational.h>

#include "bench/unfold_runs.hpp"

namespace ridgecraft::bench {
namespace {

using Exact = CGAL::Exact_rational;
using Flat = std::array<Vec2, 3>;

struct ExactPoint {
  Exact x, y;
};
using ExactTriangle = std::array<ExactPoint, 3>;

ExactTriangle exact(const Flat& t) {
  ExactTriangle e;
  for (std::size_t k = 0; k < 3; ++k) {
    e[k] = {Exact(t[k].x), Exact(t[k].y)};
  }
  return e;
}

/// Does an edge of a have all of b on its outer side, but for a depth of at most the tolerance? The rounded
/// coordinates are taken as they are; everything after that is exact, squares instead of roots.
bool separated(const ExactTriangle& a, const ExactTriangle& b, const Exact& tolerance) {
  for (std::size_t k = 0; k < 3; ++k) {
    const ExactPoint& p = a[k];
    const ExactPoint& q = a[(k + 1) % 3];
    const Exact ux = q.x - p.x;
    const Exact uy = q.y - p.y;
    Exact deepest;  // times the edge's length
    for (std::size_t j = 0; j < 3; ++j) {
      const Exact depth = ux * (b[j].y - p.y) - uy * (b[j].x - p.x);
      if (j == 0 || depth > deepest) {
        deepest = depth;
      }
    }
    if (deepest <= 0 || deepest * deepest <= tolerance * tolerance * (ux * ux + uy * uy)) {
      return true;
    }
  }
  return false;
}

/// Lays the third corner over an edge from the lengths in space.
Vec2 third_corner(Vec2 from, Vec2 to, double along, double left, double right) {
  const double x = (along * along + left * left - right * right) / (2.0 * along);
  const double y = std::sqrt(std::fmax(0.0, left * left - x * x));
  const Vec2 way = (to - from) / length(to - from);
  return from + x * way + y * Vec2{-way.y, way.x};
}

/// Lays the net flat edge by edge from lengths alone; false when the folds are no tree over all faces.
bool lay_flat(const mesh::Surface& surface, const unfold::Patch& patch, const unfold::Folds& folds,
              std::vector<Flat>& flat) {
  const std::uint32_t n = patch.size();
  const auto side_length = [&](std::uint32_t side) {
    const auto v = surface.vertices(patch.face[side / 3]);
    return length(surface.point(v[(side % 3 + 1) % 3]) - surface.point(v[side % 3]));
  };
  std::vector<std::uint8_t> laid(n, 0);
  flat.assign(n, {});
  std::vector<std::uint32_t> open{0};
  laid[0] = 1;
  flat[0][0] = {0.0, 0.0};
  flat[0][1] = {side_length(0), 0.0};
  flat[0][2] = third_corner(flat[0][0], flat[0][1], side_length(0), side_length(2), side_length(1));
  std::size_t used = 0;
  for (std::size_t i = 0; i < open.size(); ++i) {
    const std::uint32_t f = open[i];
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t side = 3 * f + k;
      if (folds[side] == 0) {
        continue;
      }
      ++used;
      const std::uint32_t twin = patch.twin[side];
      const std::uint32_t g = twin / 3;
      if (laid[g] != 0) {
        continue;
      }
      laid[g] = 1;
      const std::uint32_t j = twin % 3;
      Flat& t = flat[g];
      t[j] = flat[f][(k + 1) % 3];
      t[(j + 1) % 3] = flat[f][k];
      t[(j + 2) % 3] = third_corner(t[j], t[(j + 1) % 3], side_length(twin), side_length(3 * g + (j + 2) % 3),
                                    side_length(3 * g + (j + 1) % 3));
      open.push_back(g);
    }
  }
  return open.size() == n && used == 2 * (std::size_t{n} - 1);
}

}  // namespace

bool is_net(const mesh::Surface& surface, const unfold::Patch& patch, const unfold::Folds& folds,
            double tolerance) {
  std::vector<Flat> flat;
  if (!lay_flat(surface, patch, folds, flat)) {
    return false;
  }
  // Lengths carry an error of about 1e-12 of the model along the chain of folds: far below the tolerance.
  const Exact allowed(1.01 * tolerance);
  std::vector<ExactTriangle> triangles;
  std::vector<std::pair<Vec2, Vec2>> boxes;
  for (const Flat& t : flat) {
    triangles.push_back(exact(t));
    boxes.push_back(
        {{std::fmin(t[0].x, std::fmin(t[1].x, t[2].x)), std::fmin(t[0].y, std::fmin(t[1].y, t[2].y))},
         {std::fmax(t[0].x, std::fmax(t[1].x, t[2].x)), std::fmax(t[0].y, std::fmax(t[1].y, t[2].y))}});
  }
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (std::size_t j = i + 1; j < triangles.size(); ++j) {
      // Boxes of doubles that have no point in common are apart exactly.
      if (boxes[i].second.x < boxes[j].first.x || boxes[j].second.x < boxes[i].first.x ||
          boxes[i].second.y < boxes[j].first.y || boxes[j].second.y < boxes[i].first.y) {
        continue;
      }
      if (!separated(triangles[i], triangles[j], allowed) &&
          !separated(triangles[j], triangles[i], allowed)) {
        return false;
      }
    }
  }
  return true;
}

}  // namespace ridgecraft::bench
