// SPDX-License-Identifier: GPL-3.0-or-later
#include "verify/geometry/space.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/elementary.hpp"
#include "base/geometry.hpp"

namespace ridgecraft::verify {
namespace {

using Matrix4 = std::array<std::array<double, 4>, 4>;

Vec3 centre(std::span<const Vec3> points) {
  // Relative to the first point, which keeps the digits of a small set far from the origin.
  Vec3 sum;
  for (const Vec3 p : points) {
    sum += p - points[0];
  }
  return points[0] + sum / static_cast<double>(points.size());
}

/// Makes one entry off the diagonal zero by a turn of rows and columns p and q; `vectors` collects the
/// turns.
void rotate(Matrix4& m, Matrix4& vectors, std::size_t p, std::size_t q) {
  const double theta = (m[q][q] - m[p][p]) / (2.0 * m[p][q]);
  const double t = (theta >= 0.0 ? 1.0 : -1.0) / (std::abs(theta) + elementary::hypot(theta, 1.0));
  const double c = 1.0 / elementary::hypot(t, 1.0);
  const double s = t * c;
  for (std::size_t k = 0; k < 4; ++k) {
    const double mkp = m[k][p];
    const double mkq = m[k][q];
    m[k][p] = c * mkp - s * mkq;
    m[k][q] = s * mkp + c * mkq;
  }
  for (std::size_t k = 0; k < 4; ++k) {
    const double mpk = m[p][k];
    const double mqk = m[q][k];
    m[p][k] = c * mpk - s * mqk;
    m[q][k] = s * mpk + c * mqk;
    const double vkp = vectors[k][p];
    const double vkq = vectors[k][q];
    vectors[k][p] = c * vkp - s * vkq;
    vectors[k][q] = s * vkp + c * vkq;
  }
}

/// Eigenvector to the largest eigenvalue of a symmetric matrix, by Jacobi's method: a few sweeps make it
/// diagonal to the last digit.
std::array<double, 4> dominant_vector(Matrix4 m) {
  constexpr int most_sweeps = 40;
  Matrix4 vectors{};
  double scale = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    vectors[i][i] = 1.0;
    for (std::size_t j = 0; j < 4; ++j) {
      scale = std::fmax(scale, std::abs(m[i][j]));
    }
  }
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    double left = 0.0;
    for (std::size_t p = 0; p < 4; ++p) {
      for (std::size_t q = p + 1; q < 4; ++q) {
        // Entries this small change nothing any more, and dividing by them could overflow.
        if (std::abs(m[p][q]) > 1e-18 * scale) {
          left = std::fmax(left, std::abs(m[p][q]));
          rotate(m, vectors, p, q);
        }
      }
    }
    if (!(left > 0.0)) {
      break;
    }
  }
  std::size_t best = 0;
  for (std::size_t i = 1; i < 4; ++i) {
    best = m[i][i] > m[best][best] ? i : best;
  }
  return {vectors[0][best], vectors[1][best], vectors[2][best], vectors[3][best]};
}

Turn unit(const Turn& q) {
  const double size = std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
  return size > 0.0 ? Turn{q.w / size, q.x / size, q.y / size, q.z / size} : Turn{};
}

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

Turn Turn::about(Vec3 direction, double angle) {
  const double s = elementary::sin(0.5 * angle);
  return {elementary::cos(0.5 * angle), s * direction.x, s * direction.y, s * direction.z};
}

Vec3 Turn::operator()(Vec3 p) const {
  const Vec3 axis{x, y, z};
  const Vec3 twice = 2.0 * cross(axis, p);
  return p + w * twice + cross(axis, twice);
}

Turn operator*(const Turn& a, const Turn& b) {
  return unit({a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
               a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w});
}

Motion best_motion(std::span<const Vec3> from, std::span<const Vec3> to) {
  const Vec3 from_centre = centre(from);
  const Vec3 to_centre = centre(to);
  std::array<Vec3, 3> s{};  // row i: sum of the i-th coordinate of from times to
  for (std::size_t i = 0; i < from.size(); ++i) {
    const Vec3 p = from[i] - from_centre;
    const Vec3 q = to[i] - to_centre;
    s[0] += p.x * q;
    s[1] += p.y * q;
    s[2] += p.z * q;
  }
  const Matrix4 n = {{{s[0].x + s[1].y + s[2].z, s[1].z - s[2].y, s[2].x - s[0].z, s[0].y - s[1].x},
                      {s[1].z - s[2].y, s[0].x - s[1].y - s[2].z, s[0].y + s[1].x, s[2].x + s[0].z},
                      {s[2].x - s[0].z, s[0].y + s[1].x, -s[0].x + s[1].y - s[2].z, s[1].z + s[2].y},
                      {s[0].y - s[1].x, s[2].x + s[0].z, s[1].z + s[2].y, -s[0].x - s[1].y + s[2].z}}};
  const std::array<double, 4> q = dominant_vector(n);
  const Turn turn = unit({q[0], q[1], q[2], q[3]});
  return {turn, to_centre - turn(from_centre)};
}

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

double winding(const std::vector<Triangle3>& triangles, Vec3 p) {
  double angle = 0.0;
  for (const Triangle3& t : triangles) {
    angle += solid_angle(t[0] - p, t[1] - p, t[2] - p);
  }
  return angle / (4.0 * std::numbers::pi);
}

}  // namespace ridgecraft::verify
