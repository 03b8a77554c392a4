// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/surface/scaled_surface.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <optional>

#include "base/elementary.hpp"
#include "base/error.hpp"
#include "base/no_index.hpp"
#include "base/order.hpp"

namespace ridgecraft::segment {
namespace {

/// How far a point may be outside, for points about 1 in size: some thousand times the rounding of a
/// coordinate.
constexpr double outside_tolerance = 1e-12;
/// Pivoting can't cycle in exact arithmetic (the radius grows each time); rounding is stopped by this.
constexpr int most_pivots = 1000;

/// The ball with all given points (1 to 4) on its sphere and its centre in their affine hull; none when
/// degenerate.
std::optional<Ball> ball_through(std::span<const Vec3> on) {
  if (on.size() == 1) {
    return Ball{on[0], 0.0};
  }
  // Centre = on[0] + sum of x_j u_j with u_j = on[j] - on[0]: Gram matrix times x = half the squared lengths.
  const std::size_t n = on.size() - 1;
  std::array<Vec3, 3> u;
  std::array<std::array<double, 4>, 3> m{};
  for (std::size_t j = 0; j < n; ++j) {
    u[j] = on[j + 1] - on[0];
  }
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      m[i][j] = dot(u[i], u[j]);
    }
    m[i][n] = 0.5 * dot(u[i], u[i]);
  }
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k + 1; i < n; ++i) {
      if (std::abs(m[i][k]) > std::abs(m[pivot][k])) {
        pivot = i;
      }
    }
    std::swap(m[k], m[pivot]);
    if (std::abs(m[k][k]) < 1e-28) {
      return std::nullopt;
    }
    for (std::size_t i = 0; i < n; ++i) {
      if (i != k) {
        const double factor = m[i][k] / m[k][k];
        for (std::size_t j = k; j <= n; ++j) {
          m[i][j] -= factor * m[k][j];
        }
      }
    }
  }
  Vec3 offset;
  for (std::size_t j = 0; j < n; ++j) {
    offset += (m[j][n] / m[j][j]) * u[j];
  }
  return Ball{on[0] + offset, length(offset)};
}

struct Support {
  std::array<Vec3, 5> points;
  std::size_t count = 0;
};

/// Smallest ball around at most five points, over all their subsets; the support becomes the subset it came
/// from.
Ball solve_small(Support& support) {
  Ball best{Vec3{}, INFINITY};
  Support best_support;
  for (unsigned subset = 1; subset < (1U << support.count); ++subset) {
    Support chosen;
    for (std::size_t i = 0; i < support.count; ++i) {
      if ((subset >> i & 1U) != 0) {
        chosen.points[chosen.count++] = support.points[i];
      }
    }
    if (chosen.count > 4) {
      continue;
    }
    const auto ball = ball_through({chosen.points.data(), chosen.count});
    if (!ball || !(ball->radius < best.radius)) {
      continue;
    }
    bool encloses = true;
    for (std::size_t i = 0; i < support.count; ++i) {
      encloses =
          encloses && length(support.points[i] - ball->center) <= ball->radius + 0.1 * outside_tolerance;
    }
    if (encloses) {
      best = *ball;
      best_support = chosen;
    }
  }
  support = best_support;
  return best;
}

void scale_points(const mesh::Surface& surface, ScaledSurface& out) {
  // First by the box, so that huge or far-off coordinates lose nothing in the ball's arithmetic.
  const Box3& box = surface.bounds();
  const double diagonal = box.diagonal();
  const double first = diagonal > 0.0 && std::isfinite(diagonal) ? diagonal : 1.0;
  const Vec3 middle = box.empty() ? Vec3{} : box.low + 0.5 * box.size();
  out.points.reserve(surface.vertex_count());
  for (const Vec3 p : surface.points()) {
    out.points.push_back((p - middle) / first);
  }
  const Ball ball = smallest_enclosing_ball(out.points);
  const double radius = ball.radius > 0.0 ? ball.radius : 1.0;
  for (Vec3& p : out.points) {
    p = snap_to_grid((p - ball.center) / radius);
  }
  out.unit = first * radius;
}

/// Vertices in the order in which a space-filling curve meets them; facets by their smallest vertex.
void number_along_curve(const mesh::Surface& surface, ScaledSurface& out) {
  out.vertex_of = curve_order(out.points);
  std::vector<Vec3> points(out.points.size());
  std::vector<std::uint32_t> rank(out.points.size());
  for (std::uint32_t v = 0; v < points.size(); ++v) {
    points[v] = out.points[out.vertex_of[v]];
    rank[out.vertex_of[v]] = v;
  }
  out.points = std::move(points);
  std::vector<std::uint32_t> first(out.points.size() + 1, 0);
  std::vector<std::uint32_t> smallest(surface.face_count());
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    const auto [a, b, c] = surface.vertices(f);
    smallest[f.value()] = std::min({rank[a.value()], rank[b.value()], rank[c.value()]});
    ++first[smallest[f.value()] + 1];
  }
  std::partial_sum(first.begin(), first.end(), first.begin());
  out.face_of.resize(surface.face_count());
  for (std::uint32_t f = 0; f < smallest.size(); ++f) {
    out.face_of[first[smallest[f]]++] = f;
  }
}

/// With the numbers of number_along_curve(), where there are any.
void take_connections(const mesh::Surface& surface, ScaledSurface& out) {
  const std::size_t facets = surface.face_count();
  std::vector<std::uint32_t> facet(out.face_of.size());
  for (std::uint32_t f = 0; f < facet.size(); ++f) {
    facet[out.face_of[f]] = f;
  }
  std::vector<std::uint32_t> vertex(out.vertex_of.size());
  for (std::uint32_t v = 0; v < vertex.size(); ++v) {
    vertex[out.vertex_of[v]] = v;
  }
  out.corners.resize(facets);
  out.neighbors.resize(facets);
  for (std::uint32_t f = 0; f < facets; ++f) {
    for (unsigned k = 0; k < 3; ++k) {
      const CornerId c = mesh::corner(FaceId(facet.empty() ? f : out.face_of[f]), k);
      const std::uint32_t v = surface.vertex(c).value();
      const FaceId beyond = surface.neighbor(c);
      out.corners[f][k] = vertex.empty() ? v : vertex[v];
      out.neighbors[f][k] = facet.empty() || !beyond.valid() ? beyond.value() : facet[beyond.value()];
    }
  }
}

void index_vertices(ScaledSurface& s) {
  s.vertex_first.assign(s.vertex_count() + 1, 0);
  for (const auto& corners : s.corners) {
    for (const std::uint32_t v : corners) {
      ++s.vertex_first[v + 1];
    }
  }
  for (std::size_t v = 0; v < s.vertex_count(); ++v) {
    s.vertex_first[v + 1] += s.vertex_first[v];
  }
  std::vector<std::uint32_t> fill(s.vertex_first.begin(), s.vertex_first.end() - 1);
  s.vertex_facets.resize(3 * s.facet_count());
  for (std::uint32_t f = 0; f < s.facet_count(); ++f) {
    for (const std::uint32_t v : s.corners[f]) {
      s.vertex_facets[fill[v]++] = f;
    }
  }
}

void find_normals(ScaledSurface& s) {
  s.vertex_normals.assign(s.vertex_count(), Vec3{});
  for (std::uint32_t f = 0; f < s.facet_count(); ++f) {
    const auto& [a, b, c] = s.corners[f];
    const std::array<Vec3, 3> side{normalized(s.points[b] - s.points[a]),
                                   normalized(s.points[c] - s.points[b]),
                                   normalized(s.points[a] - s.points[c])};
    const Vec3 n = s.facet_normal(f);
    for (std::size_t k = 0; k < 3; ++k) {
      const double cosine = -dot(side[k], side[(k + 2) % 3]);
      s.vertex_normals[s.corners[f][k]] += elementary::acos(std::clamp(cosine, -1.0, 1.0)) * n;
    }
  }
  for (Vec3& n : s.vertex_normals) {
    n = normalized(n);
  }
}

/// Polygons can be torn into several pieces by repair; only what hangs together over edges can stay in one
/// part.
void find_groups(std::span<const std::uint32_t> polygon, ScaledSurface& s) {
  RIDGECRAFT_ASSERT(polygon.empty() || polygon.size() == s.facet_count());
  if (polygon.empty()) {
    return;
  }
  s.group.assign(s.facet_count(), no_index);
  std::vector<std::uint32_t> stack;
  std::uint32_t count = 0;
  for (std::uint32_t start = 0; start < s.facet_count(); ++start) {
    if (s.group[start] != no_index) {
      continue;
    }
    s.group_first.push_back(static_cast<std::uint32_t>(s.group_facets.size()));
    s.group[start] = count;
    stack.push_back(start);
    while (!stack.empty()) {
      const std::uint32_t f = stack.back();
      stack.pop_back();
      s.group_facets.push_back(f);
      for (const std::uint32_t g : s.neighbors[f]) {
        // A face that repair made belongs to no polygon (none): it is its own.
        if (g != no_index && s.group[g] == no_index && polygon[g] == polygon[f] && polygon[f] != no_index) {
          s.group[g] = count;
          stack.push_back(g);
        }
      }
    }
    ++count;
  }
  s.group_first.push_back(static_cast<std::uint32_t>(s.group_facets.size()));
  if (count == s.facet_count()) {
    s.group.clear();
    s.group_first.clear();
    s.group_facets.clear();
  }
}

}  // namespace

Ball smallest_enclosing_ball(std::span<const Vec3> points) {
  if (points.empty()) {
    return {};
  }
  Support support;
  support.points[support.count++] = points[0];
  Ball ball{points[0], 0.0};
  for (int round = 0; round < most_pivots; ++round) {
    double farthest = -1.0;
    Vec3 at;
    for (const Vec3 p : points) {
      const Vec3 d = p - ball.center;
      const double squared = dot(d, d);
      if (squared > farthest) {
        farthest = squared;
        at = p;
      }
    }
    if (std::sqrt(farthest) <= ball.radius + outside_tolerance) {
      return ball;
    }
    Support next = support;
    next.points[next.count++] = at;
    const Ball grown = solve_small(next);
    if (!(grown.radius > ball.radius) || !std::isfinite(grown.radius)) {
      // Rounding stands in the way of progress: widen the ball that is there instead.
      return {ball.center, std::sqrt(farthest)};
    }
    support = next;
    ball = grown;
  }
  return ball;
}

void extend_groups(ScaledSurface& s, std::size_t facets_before) {
  if (s.group.empty()) {
    return;
  }
  for (std::size_t f = facets_before; f < s.facet_count(); ++f) {
    s.group.push_back(static_cast<std::uint32_t>(s.group_first.size() - 1));
    s.group_facets.push_back(static_cast<std::uint32_t>(f));
    s.group_first.push_back(static_cast<std::uint32_t>(s.group_facets.size()));
  }
}

void index_and_orient(ScaledSurface& surface) {
  index_vertices(surface);
  find_normals(surface);
}

ScaledSurface scale_surface(const mesh::Surface& surface, std::span<const std::uint32_t> polygon,
                            Numbering numbering) {
  ScaledSurface scaled;
  scale_points(surface, scaled);
  std::vector<std::uint32_t> renumbered_polygon;
  if (numbering == Numbering::along_curve) {
    number_along_curve(surface, scaled);
    if (!polygon.empty()) {
      RIDGECRAFT_ASSERT(polygon.size() == surface.face_count());
      for (const std::uint32_t f : scaled.face_of) {
        renumbered_polygon.push_back(polygon[f]);
      }
      polygon = renumbered_polygon;
    }
  }
  take_connections(surface, scaled);
  index_and_orient(scaled);
  find_groups(polygon, scaled);
  return scaled;
}

}  // namespace ridgecraft::segment
