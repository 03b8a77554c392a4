// SPDX-License-Identifier: GPL-3.0-or-later
#include "verify/geometry/geometry.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numbers>

#include "base/elementary.hpp"
#include "base/geometry.hpp"
#include "verify/file/tolerance.hpp"

namespace ridgecraft::verify {
namespace {

/// The two segments have a point in common, or come as near as `touch`.
bool meet(Vec2 a, Vec2 b, Vec2 c, Vec2 d, double touch) {
  const double c_side = cross(b - a, c - a);
  const double d_side = cross(b - a, d - a);
  const double a_side = cross(d - c, a - c);
  const double b_side = cross(d - c, b - c);
  const bool crosses = ((c_side < 0.0) != (d_side < 0.0)) && ((a_side < 0.0) != (b_side < 0.0)) &&
                       c_side != 0.0 && d_side != 0.0 && a_side != 0.0 && b_side != 0.0;
  return crosses || segment_distance(a, b, c, d) <= touch;
}

/// Side b c, which follows on a b, runs back along it.
bool runs_back(Vec2 a, Vec2 b, Vec2 c, double touch) {
  return dot(b - a, c - b) < 0.0 &&
         (distance_to_segment(c, a, b) <= touch || distance_to_segment(a, b, c) <= touch);
}

// Polygons in convex parts: ear clipping, then removal of needless diagonals.

using Corner = std::uint32_t;
using Triangle = std::array<Corner, 3>;

double turn(Vec2 a, Vec2 b, Vec2 c) {
  return cross(b - a, c - a);
}

/// Cuts triangles off a counterclockwise polygon until nothing is left.
class EarClipper {
 public:
  EarClipper(std::span<const Vec2> polygon, const Context& context) : at_(polygon), context_(context) {
    const auto n = static_cast<Corner>(polygon.size());
    for (Corner i = 0; i < n; ++i) {
      next_.push_back(i + 1 < n ? i + 1 : 0);
      previous_.push_back(i > 0 ? i - 1 : n - 1);
    }
    for (Corner i = 0; i < n; ++i) {
      if (turn_at(i) <= 0.0) {
        blunt_.push_back(i);
      }
    }
    gone_.assign(n, false);
  }

  std::vector<Triangle> run() {
    std::size_t left = at_.size();
    Corner corner = 0;
    std::size_t refused = 0;
    while (left > 3) {
      context_.check();
      if (is_ear(corner)) {
        corner = cut(corner, refused);
        --left;
      } else if (++refused >= left) {
        // Only rounding, or a polygon that crosses itself, leaves no ear: give up the corner that is nearest
        // to one.
        corner = cut(flattest(corner), refused);
        --left;
      } else {
        corner = next_[corner];
      }
    }
    keep({previous_[corner], corner, next_[corner]});
    return std::move(triangles_);
  }

 private:
  [[nodiscard]] double turn_at(Corner i) const { return turn(at_[previous_[i]], at_[i], at_[next_[i]]); }

  [[nodiscard]] bool is_ear(Corner i) {
    if (turn_at(i) <= 0.0) {
      return false;
    }
    const Vec2 a = at_[previous_[i]];
    const Vec2 b = at_[i];
    const Vec2 c = at_[next_[i]];
    std::erase_if(blunt_, [this](Corner k) { return gone_[k] || turn_at(k) > 0.0; });
    return std::none_of(blunt_.begin(), blunt_.end(), [&](Corner k) {
      const Vec2 p = at_[k];
      return !(p == a || p == b || p == c) && turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 &&
             turn(c, a, p) >= 0.0;
    });
  }

  [[nodiscard]] Corner flattest(Corner start) const {
    Corner best = start;
    for (Corner i = next_[start]; i != start; i = next_[i]) {
      if (std::abs(turn_at(i)) < std::abs(turn_at(best))) {
        best = i;
      }
    }
    return best;
  }

  Corner cut(Corner i, std::size_t& refused) {
    keep({previous_[i], i, next_[i]});
    next_[previous_[i]] = next_[i];
    previous_[next_[i]] = previous_[i];
    gone_[i] = true;
    refused = 0;
    // On to the far side: ears that are taken in turns become no fan of needles.
    return next_[next_[i]];
  }

  void keep(const Triangle& t) {
    const double area = turn(at_[t[0]], at_[t[1]], at_[t[2]]);
    if (area > 0.0) {
      triangles_.push_back(t);
    } else if (area < 0.0) {
      // Only polygons that cross themselves have these. Signed triangles add up to the winding number, so
      // nothing that the outline goes round is left out when they count, too.
      triangles_.push_back({t[0], t[2], t[1]});
    }
  }

  std::span<const Vec2> at_;
  const Context& context_;
  std::vector<Corner> next_, previous_;
  std::vector<Corner> blunt_;  ///< not convex now, perhaps later; only these can lie in an ear
  std::vector<bool> gone_;
  std::vector<Triangle> triangles_;
};

/// Triangles as rings of sides that grow together where a diagonal isn't needed.
class Rings {
 public:
  Rings(std::span<const Vec2> polygon, const std::vector<Triangle>& triangles) : at_(polygon) {
    std::map<std::pair<Corner, Corner>, std::uint32_t> side_from_to;
    for (const Triangle& t : triangles) {
      const auto base = static_cast<std::uint32_t>(start_.size());
      for (std::uint32_t k = 0; k < 3; ++k) {
        start_.push_back(t[k]);
        next_.push_back(base + (k + 1) % 3);
        previous_.push_back(base + (k + 2) % 3);
        side_from_to[{t[k], t[(k + 1) % 3]}] = base + k;
      }
    }
    removed_.assign(start_.size(), false);
    for (const auto& [ends, side] : side_from_to) {
      const auto back = side_from_to.find({ends.second, ends.first});
      if (ends.first < ends.second && back != side_from_to.end()) {
        remove_if_needless(side, back->second);
      }
    }
  }

  [[nodiscard]] std::vector<Polygon> polygons() const {
    std::vector<Polygon> result;
    std::vector<bool> seen = removed_;
    for (std::uint32_t first = 0; first < start_.size(); ++first) {
      if (seen[first]) {
        continue;
      }
      Polygon& ring = result.emplace_back();
      for (std::uint32_t side = first; !seen[side]; side = next_[side]) {
        seen[side] = true;
        ring.push_back(at_[start_[side]]);
      }
    }
    return result;
  }

 private:
  [[nodiscard]] bool turns_left(std::uint32_t arriving, std::uint32_t leaving) const {
    return turn(at_[start_[arriving]], at_[start_[leaving]], at_[start_[next_[leaving]]]) >= 0.0;
  }

  void remove_if_needless(std::uint32_t side, std::uint32_t back) {
    if (!turns_left(previous_[side], next_[back]) || !turns_left(previous_[back], next_[side])) {
      return;
    }
    link(previous_[side], next_[back]);
    link(previous_[back], next_[side]);
    removed_[side] = true;
    removed_[back] = true;
  }

  void link(std::uint32_t arriving, std::uint32_t leaving) {
    next_[arriving] = leaving;
    previous_[leaving] = arriving;
  }

  std::span<const Vec2> at_;
  std::vector<Corner> start_;
  std::vector<std::uint32_t> next_, previous_;
  std::vector<bool> removed_;
};

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

double segment_distance(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
  return std::min({distance_to_segment(a, c, d), distance_to_segment(b, c, d), distance_to_segment(c, a, b),
                   distance_to_segment(d, a, b)});
}

bool is_convex(std::span<const Vec2> polygon) {
  const std::size_t n = polygon.size();
  double turned = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 a = polygon[i];
    const Vec2 b = polygon[(i + 1) % n];
    const Vec2 c = polygon[(i + 2) % n];
    const double turn = cross(b - a, c - b);
    // turn over the chord is how far b lies outside the chord from a to c.
    if (turn < -dent_tolerance_mm * length(c - a)) {
      return false;
    }
    turned += elementary::atan2(turn, dot(b - a, c - b));
  }
  // Several rounds are a star. What the tolerance lets pass is far less than half a round.
  return std::abs(turned - 2.0 * std::numbers::pi) < 1.0;
}

bool is_simple(std::span<const Vec2> polygon, const Context& context) {
  const std::size_t n = polygon.size();
  if (n == 3) {
    return doubled_area(polygon) != 0.0;
  }
  double largest = 0.0;
  for (const Vec2 corner : polygon) {
    largest = std::max({largest, std::abs(corner.x), std::abs(corner.y)});
  }
  const double touch = touch_fraction * largest;
  std::vector<Box2> boxes(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 a = polygon[i];
    const Vec2 b = polygon[(i + 1) % n];
    if (a == b || runs_back(a, b, polygon[(i + 2) % n], touch)) {
      return false;
    }
    boxes[i] = grown(box_of(std::array{a, b}), touch);
  }
  const BoxFinder tree(boxes);
  bool simple = true;
  for (std::size_t i = 0; i < n && simple; ++i) {
    context.check();
    tree.for_each_overlapping(boxes[i], [&](std::size_t j) {
      const bool neighbours = j == i || (i + 1) % n == j || (j + 1) % n == i;
      if (simple && j > i && !neighbours) {
        simple = !meet(polygon[i], polygon[(i + 1) % n], polygon[j], polygon[(j + 1) % n], touch);
      }
    });
  }
  return simple;
}

double penetration(std::span<const Vec2> a, std::span<const Vec2> b) {
  double depth = std::numeric_limits<double>::infinity();
  for (int turn = 0; turn < 2; ++turn, std::swap(a, b)) {
    for (std::size_t i = 0; i < a.size(); ++i) {
      const Vec2 origin = a[i];
      const Vec2 side = a[i + 1 < a.size() ? i + 1 : 0] - origin;
      const double size = length(side);
      if (!(size > 0.0)) {
        continue;
      }
      const Vec2 outward{side.y / size, -side.x / size};
      double nearest = std::numeric_limits<double>::infinity();
      for (const Vec2 corner : b) {
        nearest = std::min(nearest, dot(corner - origin, outward));
      }
      depth = std::min(depth, -nearest);
      if (depth <= 0.0) {
        return 0.0;
      }
    }
  }
  return std::isfinite(depth) ? depth : 0.0;
}

std::vector<Polygon> convex_parts(std::span<const Vec2> polygon, const Context& context) {
  Polygon corners(polygon.begin(), polygon.end());
  if (doubled_area(corners) < 0.0) {
    std::reverse(corners.begin(), corners.end());
  }
  if (is_convex(corners)) {
    return {std::move(corners)};
  }
  return Rings(corners, EarClipper(corners, context).run()).polygons();
}

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
