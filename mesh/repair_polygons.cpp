// SPDX-License-Identifier: GPL-3.0-or-later
// From points and polygons in memory to a repaired model.
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "base/digest.hpp"
#include "base/error.hpp"
#include "mesh/mesh.hpp"
#include "mesh/repair/repair.hpp"

namespace ridgecraft::mesh {
namespace {

bool is_finite(Vec3 p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

[[noreturn]] void refuse(const std::string& sentence) {
  throw Error(ErrorKind::unusable_mesh, sentence);
}

void require_points(std::span<const Vec3> points) {
  if (points.size() >= Soup::none) {
    refuse(fmt::format("{} points are more than can be numbered", points.size()));
  }
  const auto bad = std::find_if_not(points.begin(), points.end(), is_finite);
  if (bad != points.end()) {
    refuse(fmt::format("point {} has a coordinate that is no finite number", bad - points.begin()));
  }
}

/// Adds the bytes of numbers to a text that a digest is made of.
template <class Number>
void add_bytes(std::span<const Number> numbers, std::string& bytes) {
  bytes.append(reinterpret_cast<const char*>(numbers.data()), numbers.size_bytes());
}

std::string digest_of(const Soup& soup) {
  std::string bytes;
  add_bytes(std::span<const Vec3>(soup.points), bytes);
  add_bytes(std::span<const std::uint32_t>(soup.first_corner), bytes);
  add_bytes(std::span<const std::uint32_t>(soup.corner_point), bytes);
  return digest(bytes);
}

/// `Polygon`: a range of indices.
template <class Polygon>
Model repair_polygons(std::span<const Vec3> points, std::span<const Polygon> polygons,
                      const ReadOptions& options, const Context& context) {
  require_points(points);
  Soup soup;
  soup.points.assign(points.begin(), points.end());
  soup.first_corner.reserve(polygons.size() + 1);
  for (const Polygon& polygon : polygons) {
    for (const std::uint32_t corner : polygon) {
      if (corner >= points.size()) {
        refuse(fmt::format("polygon {} names point {}, and there are {}", soup.polygon_count(), corner,
                           points.size()));
      }
      soup.corner_point.push_back(corner);
    }
    if (soup.corner_point.size() >= Soup::none) {
      refuse("the polygons have more corners than can be numbered");
    }
    soup.first_corner.push_back(static_cast<std::uint32_t>(soup.corner_point.size()));
  }
  context.report("repairing", 0.0);
  const std::string digest = digest_of(soup);
  Model model = repair(std::move(soup), options, context);
  model.digest = digest;
  return model;
}

}  // namespace

Model repair(std::span<const Vec3> points, std::span<const std::vector<std::uint32_t>> polygons,
             const ReadOptions& options, const Context& context) {
  return repair_polygons(points, polygons, options, context);
}

Model repair(std::span<const Vec3> points, std::span<const std::array<std::uint32_t, 3>> triangles,
             const ReadOptions& options, const Context& context) {
  return repair_polygons(points, triangles, options, context);
}

}  // namespace ridgecraft::mesh
