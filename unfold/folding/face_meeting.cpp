// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/folding/face_meeting.hpp"

#include <algorithm>

#include "unfold/net/tolerance.hpp"

namespace ridgecraft::unfold {
namespace {

/// Whether all of f lies beside all of g, seen along this axis.
bool apart_along(Vec3 axis, const Corners& f, const Corners& g) {
  double f_low = dot(axis, f[0]), f_high = f_low;
  double g_low = dot(axis, g[0]), g_high = g_low;
  for (std::size_t k = 1; k < 3; ++k) {
    f_low = std::min(f_low, dot(axis, f[k]));
    f_high = std::max(f_high, dot(axis, f[k]));
    g_low = std::min(g_low, dot(axis, g[k]));
    g_high = std::max(g_high, dot(axis, g[k]));
  }
  return f_high < g_low || g_high < f_low;
}

}  // namespace

bool without_seam(const Corners& t, Corners& rest) {
  const double a = length(t[2] - t[1]);
  const double b = length(t[0] - t[2]);
  const double c = length(t[1] - t[0]);
  const double around = a + b + c;
  const double inradius = length(cross(t[1] - t[0], t[2] - t[0])) / around;
  if (!(inradius > fold_give_mm)) {
    return false;
  }
  const Vec3 centre = (a * t[0] + b * t[1] + c * t[2]) / around;
  const double scale = (inradius - fold_give_mm) / inradius;
  for (std::size_t k = 0; k < 3; ++k) {
    rest[k] = centre + scale * (t[k] - centre);
  }
  return true;
}

/// They meet where none of these axes separates them: normals, products of two sides, and for triangles in
/// one plane the sides' normals in it.
bool meet(const Corners& f, const Corners& g) {
  std::array<Vec3, 3> f_side, g_side;
  for (std::size_t k = 0; k < 3; ++k) {
    f_side[k] = f[(k + 1) % 3] - f[k];
    g_side[k] = g[(k + 1) % 3] - g[k];
  }
  const Vec3 f_normal = cross(f_side[0], f_side[1]);
  const Vec3 g_normal = cross(g_side[0], g_side[1]);
  if (apart_along(f_normal, f, g) || apart_along(g_normal, f, g)) {
    return false;
  }
  for (const Vec3 u : f_side) {
    if (apart_along(cross(f_normal, u), f, g)) {
      return false;
    }
    for (const Vec3 v : g_side) {
      if (apart_along(cross(u, v), f, g)) {
        return false;
      }
    }
  }
  return std::none_of(g_side.begin(), g_side.end(),
                      [&](Vec3 v) { return apart_along(cross(g_normal, v), f, g); });
}

}  // namespace ridgecraft::unfold
