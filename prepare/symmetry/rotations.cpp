// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/symmetry/rotations.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>
#include <utility>

#include "base/elementary.hpp"
#include "prepare/symmetry/area_frame.hpp"

namespace ridgecraft::prepare {
namespace {

/// Axes with a greater cosine between them are one.
constexpr double same_axis = 1.0 - 1e-8;
/// Mirror planes whose lines are looked at.
constexpr std::size_t most_planes = 16;

/// Turns about a line through a point (O. Rodrigues).
Isometry turn_about_line(Vec3 point, Vec3 axis, double angle) {
  const double c = elementary::cos(angle);
  const double s = elementary::sin(angle);
  Isometry turn;
  turn.motion.rows = {Vec3{c, -s * axis.z, s * axis.y} + (1.0 - c) * axis.x * axis,
                      Vec3{s * axis.z, c, -s * axis.x} + (1.0 - c) * axis.y * axis,
                      Vec3{-s * axis.y, s * axis.x, c} + (1.0 - c) * axis.z * axis};
  turn.motion.shift = point - turn.turn(point);
  return turn;
}

/// Sorts values and calls each(first, last) for every range of them that goes on without a gap.
template <class Each>
void for_each_cluster(std::vector<std::pair<double, std::size_t>>& values, double gap, Each each) {
  std::sort(values.begin(), values.end());
  std::size_t first = 0;
  for (std::size_t i = 1; i <= values.size(); ++i) {
    if (i == values.size() || values[i].first - values[i - 1].first > gap) {
      each(first, i);
      first = i;
    }
  }
}

/// Every turn of a surface onto itself turns each ring of corners at one height and one distance from the
/// axis onto itself: its folds divide their numbers.
std::size_t common_divisor(const mesh::Surface& surface, Vec3 point, Vec3 axis, double exact) {
  std::vector<std::pair<double, std::size_t>> heights;
  for (const VertexId v : ids<VertexId>(surface.vertex_count())) {
    heights.emplace_back(dot(surface.point(v) - point, axis), v.value());
  }
  std::size_t divisor = 0;
  for_each_cluster(heights, exact, [&](std::size_t first, std::size_t last) {
    std::vector<std::pair<double, std::size_t>> radii;
    for (std::size_t i = first; i < last; ++i) {
      const Vec3 p = surface.point(VertexId(heights[i].second));
      radii.emplace_back(length(cross(p - point, axis)), heights[i].second);
    }
    for_each_cluster(radii, exact, [&](std::size_t begin, std::size_t end) {
      if (radii[end - 1].first > 2.0 * exact) {
        divisor = std::gcd(divisor, end - begin);
      }
    });
  });
  return divisor;
}

}  // namespace

std::vector<Rotation> find_rotations(const mesh::Surface& surface, const SymmetryTolerance& tolerance) {
  std::vector<Rotation> found;
  if (surface.face_count() == 0) {
    return found;
  }
  const double exact = tolerance.exact * surface.bounds().largest_extent();
  const AreaFrame frame = area_frame(surface);
  std::vector<Vec3> axes{{0, 0, 1}, {0, 1, 0}, {1, 0, 0}};
  axes.insert(axes.end(), frame.axes.begin(), frame.axes.end());
  const std::vector<Mirror> mirrors = find_mirrors(surface, most_planes, tolerance);
  for (std::size_t i = 0; i < mirrors.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (mirrors[i].exact && mirrors[k].exact) {
        axes.push_back(normalized(cross(mirrors[i].plane.normal, mirrors[k].plane.normal)));
      }
    }
  }
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const bool known = std::any_of(axes.begin(), axes.begin() + static_cast<std::ptrdiff_t>(i),
                                   [&](Vec3 a) { return std::abs(dot(a, axes[i])) > same_axis; });
    const std::size_t divisor = known ? 0 : common_divisor(surface, frame.centre, axes[i], exact);
    for (std::size_t n = divisor; n >= 2; --n) {
      if (divisor % n != 0) {
        continue;
      }
      const Isometry turn =
          turn_about_line(frame.centre, axes[i], 2.0 * std::numbers::pi / static_cast<double>(n));
      Correspondence maps = correspond(surface, surface, turn, exact);
      if (maps.farthest <= exact) {
        found.push_back({frame.centre, axes[i], static_cast<unsigned>(n), turn, std::move(maps)});
        break;
      }
    }
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const Rotation& a, const Rotation& b) { return a.folds > b.folds; });
  return found;
}

}  // namespace ridgecraft::prepare
