// SPDX-License-Identifier: GPL-3.0-or-later
#include "solid/rays.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace ridgecraft::solid {
namespace {

/// Where a ray passes through its cell: elsewhere from row to row and from column to column, by shares that
/// no fraction comes near, so that sides along the axes are seen as exactly as others.
constexpr std::array<double, 2> shift{0.6180339887498949, 0.7548776662466927};
constexpr std::array<double, 2> start{0.3819660112501051, 0.2451223337533073};

/// A ray passes through a surface.
struct Crossing {
  std::uint32_t ray;
  double height;
  int sign;  ///< +1: leaves
};

std::array<double, 3> coordinates(Vec3 p) {
  return {p.x, p.y, p.z};
}

/// True where p is to the left of the line from a to b. The same line the other way round gives the opposite
/// answer, also where p is on it.
bool is_left(Vec2 p, Vec2 a, Vec2 b, double& doubled_area) {
  const bool turned = std::tie(b.x, b.y) < std::tie(a.x, a.y);
  const Vec2 from = turned ? b : a;
  const Vec2 to = turned ? a : b;
  const double area = cross(to - from, p - from);
  doubled_area = turned ? -area : area;
  return turned ? area < 0.0 : area >= 0.0;
}

}  // namespace

double total(const Stretches& stretches) {
  double sum = 0.0;
  for (const Stretch& s : stretches) {
    sum += s.to - s.from;
  }
  return sum;
}

Stretches united(Stretches any) {
  std::sort(any.begin(), any.end(), [](const Stretch& a, const Stretch& b) {
    return std::tie(a.ray, a.from, a.to) < std::tie(b.ray, b.from, b.to);
  });
  Stretches result;
  for (const Stretch& s : any) {
    if (!result.empty() && result.back().ray == s.ray && s.from <= result.back().to) {
      result.back().to = std::max(result.back().to, s.to);
    } else {
      result.push_back(s);
    }
  }
  return result;
}

Stretches difference(const Stretches& a, const Stretches& b) {
  Stretches result;
  std::size_t first = 0;
  for (Stretch rest : a) {
    while (first < b.size() &&
           (b[first].ray < rest.ray || (b[first].ray == rest.ray && b[first].to <= rest.from))) {
      ++first;
    }
    for (std::size_t i = first; i < b.size() && b[i].ray == rest.ray && b[i].from < rest.to; ++i) {
      if (b[i].from > rest.from) {
        result.push_back({rest.ray, rest.from, b[i].from});
      }
      rest.from = std::max(rest.from, b[i].to);
    }
    if (rest.from < rest.to) {
      result.push_back(rest);
    }
  }
  return result;
}

Rays::Rays(const Box3& box, unsigned axis, double step) : axis_(axis), step_(step) {
  const std::array<double, 3> low = turned(box.low);
  const std::array<double, 3> high = turned(box.high);
  for (const unsigned k : {0U, 1U}) {
    low_[k] = low[k];
    count_[k] = static_cast<std::uint32_t>(std::fmax(1.0, std::ceil((high[k] - low[k]) / step)));
  }
}

std::array<double, 3> Rays::turned(Vec3 p) const {
  const std::array<double, 3> c = coordinates(p);
  return {c[(axis_ + 1) % 3], c[(axis_ + 2) % 3], c[axis_]};
}

Vec2 Rays::place(std::uint32_t i, std::uint32_t j) const {
  const auto part = [](double x) { return x - std::floor(x); };
  return {low_[0] + (i + part(j * shift[0] + start[0])) * step_,
          low_[1] + (j + part(i * shift[1] + start[1])) * step_};
}

std::uint32_t Rays::cell_of(double x, unsigned direction) const {
  return static_cast<std::uint32_t>(
      std::clamp((x - low_[direction]) / step_, 0.0, static_cast<double>(count_[direction] - 1)));
}

Vec3 Rays::point(std::uint32_t ray, double height) const {
  const Vec2 p = place(ray % count_[0], ray / count_[0]);
  std::array<double, 3> c{};
  c[(axis_ + 1) % 3] = p.x;
  c[(axis_ + 2) % 3] = p.y;
  c[axis_] = height;
  return {c[0], c[1], c[2]};
}

template <class Visit>
void Rays::for_each_hit(const std::array<Vec3, 3>& corners, const Visit& visit) const {
  std::array<Vec2, 3> flat;
  std::array<double, 3> height{};
  Box2 box;
  for (unsigned i = 0; i < 3; ++i) {
    const std::array<double, 3> c = turned(corners[i]);
    flat[i] = {c[0], c[1]};
    height[i] = c[2];
    box.add(flat[i]);
  }
  const std::uint32_t last_i = cell_of(box.high.x, 0);
  const std::uint32_t last_j = cell_of(box.high.y, 1);
  for (std::uint32_t j = cell_of(box.low.y, 1); j <= last_j; ++j) {
    for (std::uint32_t i = cell_of(box.low.x, 0); i <= last_i; ++i) {
      const Vec2 p = place(i, j);
      std::array<double, 3> share{};
      const bool left = is_left(p, flat[1], flat[2], share[0]);
      if (is_left(p, flat[2], flat[0], share[1]) != left || is_left(p, flat[0], flat[1], share[2]) != left) {
        continue;
      }
      const double area = share[0] + share[1] + share[2];
      const double at = area == 0.0
                            ? height[0]
                            : (share[0] * height[0] + share[1] * height[1] + share[2] * height[2]) / area;
      visit(j * count_[0] + i, at, left ? 1 : -1);
    }
  }
}

Stretches Rays::inside(const mesh::Surface& surface, std::span<const FaceId> faces) const {
  std::vector<Crossing> crossings;
  for (const FaceId f : faces) {
    const auto [a, b, c] = surface.vertices(f);
    for_each_hit({surface.point(a), surface.point(b), surface.point(c)},
                 [&](std::uint32_t ray, double height, int sign) {
                   crossings.push_back({ray, height, sign});
                 });
  }
  std::sort(crossings.begin(), crossings.end(), [](const Crossing& a, const Crossing& b) {
    return std::tie(a.ray, a.height, a.sign) < std::tie(b.ray, b.height, b.sign);
  });
  Stretches result;
  int winding = 0;
  for (std::size_t i = 0; i + 1 < crossings.size(); ++i) {
    const Crossing& c = crossings[i];
    const Crossing& next = crossings[i + 1];
    winding = next.ray == c.ray ? winding - c.sign : 0;
    if (winding > 0 && next.ray == c.ray && c.height < next.height) {
      result.push_back({c.ray, c.height, next.height});
    }
  }
  return united(std::move(result));
}

Stretches Rays::inside(const Body& convex) const {
  Stretches met;
  for (const auto& [a, b, c] : convex.triangles) {
    for_each_hit({convex.points[a], convex.points[b], convex.points[c]},
                 [&](std::uint32_t ray, double height, int /*sign*/) {
                   met.push_back({ray, height, height});
                 });
  }
  std::sort(met.begin(), met.end(), [](const Stretch& a, const Stretch& b) {
    return std::tie(a.ray, a.from) < std::tie(b.ray, b.from);
  });
  Stretches result;
  for (const Stretch& s : met) {
    if (result.empty() || result.back().ray != s.ray) {
      result.push_back(s);
    }
    result.back().to = s.to;
  }
  return result;
}

}  // namespace ridgecraft::solid
