// SPDX-License-Identifier: GPL-3.0-or-later
#include "solid/cage_check.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/elementary.hpp"
#include "base/error.hpp"

namespace ridgecraft::solid {
namespace {

/// Sine of the angle at which a point is taken to lie in a triangle's plane; rounding leaves about 1e-15.
constexpr double in_plane = 1e-12;

/// The number of each point, the same for points in one place.
std::vector<std::uint32_t> numbers_of_places(const std::vector<Vec3>& points) {
  std::map<std::tuple<double, double, double>, std::uint32_t> number;
  std::vector<std::uint32_t> place;
  place.reserve(points.size());
  for (const Vec3 p : points) {
    const auto next = static_cast<std::uint32_t>(place.size());
    place.push_back(number.try_emplace({p.x, p.y, p.z}, next).first->second);
  }
  return place;
}

/// How many triangles run along an edge from its smaller point number to the larger, and back.
using Runs = std::map<std::pair<std::uint32_t, std::uint32_t>, std::array<std::size_t, 2>>;

Runs runs_along_edges(const solid::Body& cage) {
  const std::vector<std::uint32_t> place = numbers_of_places(cage.points);
  Runs runs;
  for (const auto& triangle : cage.triangles) {
    const std::array corners{place[triangle[0]], place[triangle[1]], place[triangle[2]]};
    if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) {
      continue;  // has shrunk to an edge: its neighbours meet there
    }
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t from = corners[i];
      const std::uint32_t to = corners[(i + 1) % 3];
      ++runs[std::minmax(from, to)][from < to ? 0 : 1];
    }
  }
  return runs;
}

/// True where the rays to a triangle's corners span the whole angle around the point: it lies on the
/// triangle. Otherwise the solid angle of the triangle is added.
bool lies_on(Vec3 point, const std::array<Vec3, 3>& triangle, double& angle) {
  std::array<Vec3, 3> to;
  for (std::size_t i = 0; i < 3; ++i) {
    const double distance = length(triangle[i] - point);
    if (distance == 0.0) {
      return true;
    }
    to[i] = (triangle[i] - point) / distance;
  }
  const double volume = dot(to[0], cross(to[1], to[2]));
  const double around = 1.0 + dot(to[0], to[1]) + dot(to[1], to[2]) + dot(to[2], to[0]);
  if (std::abs(volume) <= in_plane && around <= in_plane) {
    return true;
  }
  angle += 2.0 * elementary::atan2(volume, around);
  return false;
}

bool outside(Vec3 point, const solid::Body& cage) {
  double angle = 0.0;
  for (const auto& [a, b, c] : cage.triangles) {
    if (lies_on(point, {cage.points[a], cage.points[b], cage.points[c]}, angle)) {
      return false;
    }
  }
  return std::abs(angle) < 2.0 * std::numbers::pi;  // whole turns are 4 pi each
}

}  // namespace

void require_closed(const std::string& file, const solid::Body& cage) {
  struct Kind {
    const char* one;
    const char* several;
    std::size_t count = 0;
    std::pair<std::uint32_t, std::uint32_t> first;
  };
  std::array kinds{
      Kind{"edge has a triangle on one side only", "edges have a triangle on one side only", {}, {}},
      Kind{"edge has more than two triangles", "edges have more than two triangles", {}, {}},
      Kind{"edge lies between triangles that face opposite ways",
           "edges lie between triangles that face opposite ways",
           {},
           {}}};
  for (const auto& [ends, runs] : runs_along_edges(cage)) {
    const std::size_t all = runs[0] + runs[1];
    if (all != 2 || runs[0] != runs[1]) {
      Kind& kind = kinds[all == 1 ? 0 : all > 2 ? 1 : 2];
      kind.first = kind.count++ == 0 ? ends : kind.first;
    }
  }
  for (const Kind& kind : kinds) {
    if (kind.count > 0) {
      const Vec3 a = cage.points[kind.first.first];
      const Vec3 b = cage.points[kind.first.second];
      throw Error(
          ErrorKind::unusable_mesh,
          fmt::format("{} isn't closed, as a cage has to be: {} {}, {} ({:g}, {:g}, {:g}) to ({:g}, {:g}, "
                      "{:g})",
                      file, kind.count, kind.count == 1 ? kind.one : kind.several,
                      kind.count == 1 ? "from" : "the first from", a.x, a.y, a.z, b.x, b.y, b.z),
          file);
    }
  }
}

std::size_t count_outside(std::span<const Vec3> points, const solid::Body& cage, const Context& context) {
  constexpr std::size_t between_checks = 64;
  std::size_t count = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i % between_checks == 0) {
      context.check();
    }
    count += outside(points[i], cage) ? 1U : 0U;
  }
  return count;
}

}  // namespace ridgecraft::solid
