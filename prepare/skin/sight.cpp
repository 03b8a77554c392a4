// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/skin/sight.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/elementary.hpp"

namespace ridgecraft::prepare {
namespace {

constexpr int looks = 64;
/// A look begins so far beside the surface, share of the diagonal.
constexpr double beside = 1e-7;

Box3 box_of(const Screen& screen) {
  Box3 box;
  std::for_each(screen.corners.begin(), screen.corners.end(), [&](Vec3 p) { box.add(p); });
  return box;
}

/// Even over the sphere, and along no axis (Gonzalez: Measurement of areas on a sphere, 2010).
Vec3 direction(int i) {
  const double z = 1.0 - (2.0 * i + 1.0) / looks;
  const double angle = 0.4 + i * std::numbers::pi * (3.0 - std::sqrt(5.0));
  const double r = std::sqrt(1.0 - z * z);
  return {r * elementary::cos(angle), r * elementary::sin(angle), z};
}

bool comes_near(Vec3 from, Vec3 way, const Box3& box) {
  double enters = 0.0;
  double leaves = 1.0;
  const auto clip = [&](double start, double step, double low, double high) {
    const double a = (low - start) / step;
    const double b = (high - start) / step;
    enters = std::max(enters, std::min(a, b));
    leaves = std::min(leaves, std::max(a, b));
  };
  clip(from.x, way.x, box.low.x, box.high.x);
  clip(from.y, way.y, box.low.y, box.high.y);
  clip(from.z, way.z, box.low.z, box.high.z);
  return enters <= leaves + 1e-9;
}

/// Möller and Trumbore, Fast, minimum storage ray/triangle intersection, 1997.
bool meets(Vec3 from, Vec3 way, const std::array<Vec3, 3>& t) {
  const Vec3 u = t[1] - t[0];
  const Vec3 v = t[2] - t[0];
  const Vec3 p = cross(way, v);
  const double determinant = dot(u, p);
  if (determinant == 0.0) {
    return false;
  }
  const Vec3 s = from - t[0];
  const double a = dot(s, p) / determinant;
  const Vec3 q = cross(s, u);
  const double b = dot(way, q) / determinant;
  return a >= 0.0 && b >= 0.0 && a + b <= 1.0 && dot(v, q) / determinant > 0.0;
}

}  // namespace

Sight::Sight(std::vector<Screen> screens)
    : screens_(std::move(screens)),
      tree_(
          screens_.size(), [&](std::uint32_t i) { return box_of(screens_[i]); },
          [&](std::uint32_t i) {
            const auto& c = screens_[i].corners;
            return (c[0] + c[1] + c[2]) / 3.0;
          }) {
  diagonal_ = tree_.box(0).diagonal();
}

bool Sight::passes(Vec3 from, Vec3 way, std::vector<std::uint32_t>& openings) const {
  bool out = true;
  tree_.search([&](std::uint32_t node) { return out && comes_near(from, way, tree_.box(node)); },
               [&](std::uint32_t place) {
                 const Screen& screen = screens_[tree_.order()[place]];
                 if (out && meets(from, way, screen.corners)) {
                   out = screen.opening != Screen::wall;
                   openings.push_back(screen.opening);
                 }
               });
  return out;
}

std::vector<std::uint32_t> Sight::openings_seen(Vec3 place, Vec3 normal) const {
  std::vector<std::uint32_t> seen;
  const Vec3 from = place + beside * diagonal_ * normalized(normal);
  for (int i = 0; i < looks; ++i) {
    const Vec3 way = direction(i);
    if (dot(way, normal) <= 0.0) {
      continue;
    }
    std::vector<std::uint32_t> openings;
    if (passes(from, 2.0 * diagonal_ * way, openings)) {
      std::sort(openings.begin(), openings.end());
      openings.erase(std::unique(openings.begin(), openings.end()), openings.end());
      seen.insert(seen.end(), openings.begin(), openings.end());
    }
  }
  return seen;
}

bool Sight::gets_out(Vec3 place, Vec3 normal) const {
  const Vec3 from = place + beside * diagonal_ * normalized(normal);
  std::vector<std::uint32_t> openings;
  for (int i = 0; i < looks; ++i) {
    const Vec3 way = direction(i);
    if (dot(way, normal) > 0.0 && passes(from, 2.0 * diagonal_ * way, openings)) {
      return true;
    }
  }
  return false;
}

}  // namespace ridgecraft::prepare
