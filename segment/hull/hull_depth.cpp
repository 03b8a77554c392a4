// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/hull/hull_depth.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/elementary.hpp"

namespace ridgecraft::segment {
namespace {

/// A triangle whose doubled area is below this share of its longest side squared is a sliver.
constexpr double sliver_share = 1e-7;

/// Finer cells would cost more to look at than they save, however many planes there are.
constexpr std::uint32_t most_squares = 32;

/// Number of the cell that a direction meets when each side of the cube has squares * squares.
std::uint32_t cell_of(Vec3 n, std::uint32_t squares) {
  const double x = std::abs(n.x);
  const double y = std::abs(n.y);
  const double z = std::abs(n.z);
  double main = n.x;
  double u = n.y;
  double v = n.z;
  std::uint32_t side = 0;
  if (y > x && y >= z) {
    main = n.y;
    u = n.z;
    v = n.x;
    side = 2;
  } else if (z > x) {
    main = n.z;
    u = n.x;
    v = n.y;
    side = 4;
  }
  side += main < 0.0 ? 1U : 0U;
  const auto square = [&](double w) {
    const double along = 0.5 * (w / std::abs(main) + 1.0) * squares;
    return std::min(squares - 1, static_cast<std::uint32_t>(std::max(0.0, along)));
  };
  return (side * squares + square(u)) * squares + square(v);
}

}  // namespace

bool is_sliver(Vec3 a, Vec3 b, Vec3 c) {
  const Vec3 u = b - a;
  const Vec3 v = c - a;
  const Vec3 w = c - b;
  return length(cross(u, v)) <= sliver_share * std::max({dot(u, u), dot(v, v), dot(w, w)});
}

void find_hull_planes(const Hull& hull, std::span<const Vec3> points, std::vector<HullPlane>& planes) {
  planes.clear();
  for (std::uint32_t t = 0; t < hull.triangles.size(); ++t) {
    const auto& [a, b, c] = hull.triangles[t];
    if (is_sliver(points[a], points[b], points[c])) {
      continue;
    }
    const Vec3 outward = cross(points[b] - points[a], points[c] - points[a]);
    const Vec3 normal = outward / length(outward);
    planes.push_back({normal, dot(normal, points[a]), t});
  }
}

void PlaneDirections::assign(std::span<const HullPlane> planes, Vec3 centre) {
  centre_ = centre;
  // 6 s^2 cells of n / (6 s^2) planes: about as many planes in a cell as cells at s = (n / 36)^(1/4).
  const double even = elementary::pow(static_cast<double>(planes.size()) / 36.0, 0.25);
  const std::uint32_t squares = std::min(most_squares, static_cast<std::uint32_t>(even) + 1);
  first_.assign(std::size_t{6} * squares * squares + 1, 0);
  place_.resize(planes.size());
  for (std::size_t i = 0; i < planes.size(); ++i) {
    place_[i] = cell_of(planes[i].normal, squares);
    ++first_[place_[i] + 1];
  }
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  cells_.resize(first_.size() - 1);
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    cells_[c] = Cell{};
    cells_[c].begin = cells_[c].end = first_[c];
  }
  planes_.resize(planes.size());
  for (std::size_t i = 0; i < planes.size(); ++i) {
    Cell& cell = cells_[place_[i]];
    planes_[cell.end++] = planes[i];
    cell.least_offset = std::min(cell.least_offset, planes[i].offset - dot(planes[i].normal, centre));
    cell.normals.add(planes[i].normal);
  }
  std::erase_if(cells_, [](const Cell& cell) { return cell.begin == cell.end; });
}

/// Cosine below which a normal counts as parallel to a plane.
constexpr double parallel_cosine = 1e-9;
/// Cosine to the vertex normal above which a facet of the hull doesn't lie behind the surface: walls of
/// vessels lean a little.
constexpr double least_opening_cosine = -0.3;
/// A hull that is thinner than this many times the scale of openings has flat sides, no openings.
constexpr double opening_thickness = 8.0;
/// Distance at which a vertex counts as lying in a plane, on the unit sphere.
constexpr double on_plane = 1e-9;
/// Below all cosines.
constexpr double any_cosine = -2.0;
/// Vertices looked at between two questions whether to stop: at most some milliseconds.
constexpr std::size_t questions_per_check = 64;

HullDepth::HullDepth(const ScaledSurface& surface, const Context& context)
    : surface_(&surface),
      context_(&context),
      mark_(surface.vertex_count(), 0),
      depth_(surface.vertex_count(), 0.0) {}

void HullDepth::select(const Hull& hull, HullIs is) {
  hull_ = &hull;
  is_ = is;
  has_planes_ = false;
  last_ = 0;
  far_triangle_ = 0;
  far_corner_ = 0;
  ++current_;
  for (const std::uint32_t v : hull.vertices) {
    mark_[v] = current_;
    depth_[v] = 0.0;
  }
}

std::uint32_t HullDepth::across(std::uint32_t triangle, std::size_t side) const {
  const auto& [one, two] = hull_->edge_triangles[hull_->triangle_edges[triangle][side]];
  return one == triangle ? two : one;
}

/// Infinite where the plane is behind or the triangle is too thin to have one.
double HullDepth::to_plane(std::uint32_t triangle, Vec3 p, Vec3 n) const {
  const auto& points = surface_->points;
  const auto& [a, b, c] = hull_->triangles[triangle];
  const Vec3 outward = cross(points[b] - points[a], points[c] - points[a]);
  const double cosine = dot(outward, n);
  if (is_sliver(points[a], points[b], points[c]) || cosine <= parallel_cosine * length(outward)) {
    return INFINITY;
  }
  return std::max(0.0, dot(outward, points[a] - p)) / cosine;
}

/// The triangle through which the ray from p along n leaves the hull: seen from p, triangles tile the sphere
/// of directions, and each step crosses a side that n lies beyond. Nothing where rounding sends the walk in
/// circles or p isn't inside.
std::optional<std::uint32_t> HullDepth::walk(Vec3 p, Vec3 n) {
  const auto& points = surface_->points;
  // A straight walk over a round hull of t triangles takes about their square root.
  const std::size_t most_steps = 64 + 8 * static_cast<std::size_t>(std::sqrt(hull_->triangles.size()));
  std::uint32_t t = last_;
  for (std::size_t step = 0; step < most_steps; ++step) {
    const auto& [a, b, c] = hull_->triangles[t];
    const Vec3 to_a = points[a] - p;
    const Vec3 to_b = points[b] - p;
    const Vec3 to_c = points[c] - p;
    const std::array<double, 3> beyond{dot(n, cross(to_a, to_b)), dot(n, cross(to_b, to_c)),
                                       dot(n, cross(to_c, to_a))};
    const auto side =
        static_cast<std::size_t>(std::min_element(beyond.begin(), beyond.end()) - beyond.begin());
    if (beyond[side] >= 0.0) {
      last_ = t;
      return t;
    }
    t = across(t, side);
  }
  return std::nullopt;
}

double HullDepth::along_normal(std::uint32_t v) {
  const Vec3 p = surface_->points[v];
  const Vec3 n = surface_->vertex_normals[v];
  if (const auto exit = walk(p, n)) {
    // The hull is that of points lifted a little (hull.hpp), so a neighbour's plane may be a little nearer;
    // and the triangle may be a sliver.
    double depth = to_plane(*exit, p, n);
    for (std::size_t side = 0; side < 3; ++side) {
      depth = std::min(depth, to_plane(across(*exit, side), p, n));
    }
    if (std::isfinite(depth)) {
      return depth;
    }
  }
  double depth = INFINITY;
  for (std::uint32_t t = 0; t < hull_->triangles.size(); ++t) {
    depth = std::min(depth, to_plane(t, p, n));
  }
  return depth;
}

void HullDepth::find_planes() {
  const auto& points = surface_->points;
  Box3 box;
  for (const std::uint32_t v : hull_->vertices) {
    box.add(points[v]);
  }
  find_hull_planes(*hull_, points, found_);
  planes_.assign(found_, 0.5 * (box.low + box.high));
  thickness_.assign(hull_->triangles.size(), Thickness::unknown);
  has_planes_ = true;
}

/// Whether some vertex lies far enough behind the triangle's plane. From the one that was far behind the last
/// plane, over edges to ever farther ones: on a convex body no neighbour is farther only where none is.
bool HullDepth::is_thick(const HullPlane& plane) {
  Thickness& known = thickness_[plane.number];
  if (known != Thickness::unknown) {
    return known == Thickness::thick;
  }
  const double needed = opening_thickness * opening_scale;
  const auto behind = [&](std::uint32_t triangle, std::size_t corner) {
    return plane.offset - dot(plane.normal, surface_->points[hull_->triangles[triangle][corner]]);
  };
  double farthest = behind(far_triangle_, far_corner_);
  std::uint32_t triangle = far_triangle_;
  std::size_t corner = far_corner_;
  // Round the farthest vertex, beginning anew at each one that is farther.
  for (std::size_t turned = 0; farthest < needed && turned < hull_->triangles.size(); ++turned) {
    const std::size_t next = (corner + 1) % 3;
    if (const double distance = behind(triangle, next); distance > farthest) {
      farthest = distance;
      far_triangle_ = triangle;
      far_corner_ = corner = next;
      turned = 0;
      continue;
    }
    const std::uint32_t centre = hull_->triangles[triangle][corner];
    triangle = across(triangle, (corner + 2) % 3);
    const auto& corners = hull_->triangles[triangle];
    corner = static_cast<std::size_t>(std::find(corners.begin(), corners.end(), centre) - corners.begin());
    if (triangle == far_triangle_) {
      break;
    }
  }
  if (farthest <= on_plane) {
    // Begun amid a flat side that lies in the plane: no neighbour is farther there, but others may be.
    for (const std::uint32_t v : hull_->vertices) {
      farthest = std::max(farthest, plane.offset - dot(plane.normal, surface_->points[v]));
    }
  }
  known = farthest >= needed ? Thickness::thick : Thickness::thin;
  return known == Thickness::thick;
}

/// Infinite where there is no opening within their scale. An inner hull may have other facets and is
/// thinner, so of it any facet counts.
double HullDepth::beside_opening(std::uint32_t v) {
  if (!has_planes_) {
    find_planes();
  }
  if (++unchecked_ >= questions_per_check) {
    unchecked_ = 0;
    context_->check();
  }
  const bool inner = is_ == HullIs::inner;
  const double nearest = planes_.nearest(surface_->points[v], surface_->vertex_normals[v], opening_scale,
                                         inner ? any_cosine : least_opening_cosine,
                                         [&](const HullPlane& plane) { return inner || is_thick(plane); });
  return std::max(0.0, nearest);
}

double HullDepth::at(std::uint32_t v, double above) {
  if (mark_[v] != current_) {
    mark_[v] = current_;
    const bool unlimited = hull_->flat || surface_->vertex_normals[v] == Vec3{};
    depth_[v] = unlimited ? static_cast<double>(INFINITY) : along_normal(v);
    if (!unlimited && depth_[v] > above) {
      depth_[v] = std::min(depth_[v], beside_opening(v));
    }
  }
  return depth_[v];
}

}  // namespace ridgecraft::segment
