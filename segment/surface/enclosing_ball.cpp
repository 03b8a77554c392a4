// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/surface/enclosing_ball.hpp"

#include <array>
#include <cstddef>
#include <optional>

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

}  // namespace ridgecraft::segment
