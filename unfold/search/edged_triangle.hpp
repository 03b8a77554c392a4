// SPDX-License-Identifier: GPL-3.0-or-later
// A triangle with its edges as half-planes worked out once: the overlap test of the inner loops.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/geometry.hpp"
#include "unfold/patch/triangle.hpp"
#include "unfold/search/lanes.hpp"

namespace ridgecraft::unfold {

/// Edge k's outward unit normal is (x[k], y[k]); no corner of the triangle is farther along it than reach[k].
/// Lane 3 repeats lane 0, so that four lanes can be worked at a time without a remainder. An edge without
/// length has reach infinity: it never separates.
struct EdgedTriangle {
  Triangle corner{};
  std::array<DoubleLanes, 2> x{}, y{}, reach{};
};

[[nodiscard]] inline EdgedTriangle edged(const Triangle& t) {
  EdgedTriangle e;
  e.corner = t;
  for (unsigned lane = 0; lane < 4; ++lane) {
    const unsigned k = lane % 3;
    const Vec2 along = t[(k + 1) % 3] - t[k];
    const double size = length(along);
    const Vec2 out = size > 0.0 ? Vec2{along.y / size, -along.x / size} : Vec2{};
    e.x[lane / 2][lane % 2] = out.x;
    e.y[lane / 2][lane % 2] = out.y;
    e.reach[lane / 2][lane % 2] = size > 0.0
                                      ? std::max(dot(out, t[0]), std::max(dot(out, t[1]), dot(out, t[2])))
                                      : std::numeric_limits<double>::infinity();
  }
  return e;
}

[[nodiscard]] inline EdgedTriangle moved(const EdgedTriangle& e, const Rigid& motion) {
  EdgedTriangle m;
  m.corner = {motion(e.corner[0]), motion(e.corner[1]), motion(e.corner[2])};
  for (unsigned half = 0; half < 2; ++half) {
    m.x[half] = motion.cosine * e.x[half] - motion.sine * e.y[half];
    m.y[half] = motion.sine * e.x[half] + motion.cosine * e.y[half];
    m.reach[half] = e.reach[half] + m.x[half] * motion.shift.x + m.y[half] * motion.shift.y;
  }
  return m;
}

/// Whether an edge of a separates b from a but for a depth of at most the tolerance.
[[nodiscard]] inline bool separates(const EdgedTriangle& a, const EdgedTriangle& b, double tolerance) {
  std::array<DoubleLanes, 2> gap;
  for (unsigned half = 0; half < 2; ++half) {
    const DoubleLanes d0 = a.x[half] * b.corner[0].x + a.y[half] * b.corner[0].y;
    const DoubleLanes d1 = a.x[half] * b.corner[1].x + a.y[half] * b.corner[1].y;
    const DoubleLanes d2 = a.x[half] * b.corner[2].x + a.y[half] * b.corner[2].y;
    gap[half] = smaller(smaller(d0, d1), d2) - a.reach[half];
  }
  const DoubleLanes widest = larger(gap[0], gap[1]);
  return (widest[0] > widest[1] ? widest[0] : widest[1]) >= -tolerance;
}

/// As overlap() of unfold/patch/triangle.hpp, but for rounding.
[[nodiscard]] inline bool overlap(const EdgedTriangle& a, const EdgedTriangle& b, double tolerance) {
  return !separates(a, b, tolerance) && !separates(b, a, tolerance);
}

}  // namespace ridgecraft::unfold
