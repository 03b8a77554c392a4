// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/symmetry/rotations.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <utility>
#include <vector>

#include "base/elementary.hpp"
#include "prepare/symmetry/area_frame.hpp"
#include "prepare/symmetry/correspondence.hpp"
#include "prepare/symmetry/isometry.hpp"
#include "prepare/symmetry/nearby_points.hpp"
#include "prepare/symmetry/seen_edges.hpp"

namespace ridgecraft::prepare {
namespace {

/// Axes with a greater cosine between them are one.
constexpr double same_axis = 1.0 - 1e-8;
/// Lines along one axis that are nearer to each other than this share of the extent are one.
constexpr double same_line = 1e-4;
/// What lies nearer to an axis than this share of the extent hardly moves, and says nothing of turns.
constexpr double near_axis = 0.05;
/// Turns are tried up to this order: more turns than that are about the sides of something round.
constexpr unsigned highest_order = 12;
/// A turn is looked at closely when of so many corners at most a share somewhat smaller than that asked for
/// stays on corners.
constexpr std::size_t most_samples = 150;
constexpr double sample_reserve = 0.1;
/// A turn of lower order has to lay so many times as much on itself to be taken instead.
constexpr double clearly_more = 1.05;

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

/// A line that partial turns are about, and those of the surface's corners that tell of them.
struct SampledAxis {
  Vec3 point;
  Vec3 axis;
  std::vector<Vec3> samples;
};

std::vector<SampledAxis> sampled_axes(const mesh::Surface& surface) {
  const AreaFrame frame = area_frame(surface);
  const Box3 box = surface.bounds();
  std::vector<Vec3> axes{{0, 0, 1}, {0, 1, 0}, {1, 0, 0}};
  for (const Vec3 axis : frame.axes) {
    if (std::none_of(axes.begin(), axes.end(), [&](Vec3 a) { return std::abs(dot(a, axis)) > same_axis; })) {
      axes.push_back(axis);
    }
  }
  std::vector<SampledAxis> result;
  for (const Vec3 axis : axes) {
    const Vec3 middle = 0.5 * (box.low + box.high);
    std::vector<Vec3> points{middle};
    if (length(cross(frame.centre - middle, axis)) > same_line * box.largest_extent()) {
      points.push_back(frame.centre);
    }
    for (const Vec3 point : points) {
      std::vector<Vec3> far;
      for (const VertexId v : ids<VertexId>(surface.vertex_count())) {
        if (length(cross(surface.point(v) - point, axis)) > near_axis * box.largest_extent()) {
          far.push_back(surface.point(v));
        }
      }
      const std::size_t step = far.size() / most_samples + 1;
      std::vector<Vec3> samples;
      for (std::size_t i = 0; i < far.size(); i += step) {
        samples.push_back(far[i]);
      }
      result.push_back({point, axis, std::move(samples)});
    }
  }
  return result;
}

}  // namespace

std::optional<PartialRotation> widest_rotation(const mesh::Surface& surface, double near, double least_share,
                                               unsigned least_order) {
  std::vector<Vec3> points;
  std::vector<std::uint32_t> numbers;
  for (const VertexId v : ids<VertexId>(surface.vertex_count())) {
    numbers.push_back(static_cast<std::uint32_t>(points.size()));
    points.push_back(surface.point(v));
  }
  const NearbyPoints nearby(points, std::move(numbers));
  const IdVector<EdgeId, double> seen = seen_lengths(surface);
  const double least = least_share * std::accumulate(seen.begin(), seen.end(), 0.0);
  const double radius = near * surface.bounds().largest_extent();
  PartialRotation best;
  double most = 0.0;
  for (const SampledAxis& line : sampled_axes(surface)) {
    for (unsigned order = highest_order; order >= least_order; --order) {
      const Isometry turn = turn_about_line(line.point, line.axis, 2.0 * std::numbers::pi / order);
      const auto stay = std::count_if(line.samples.begin(), line.samples.end(),
                                      [&](Vec3 p) { return nearby.nearest(turn(p), radius) != no_point; });
      if (static_cast<double>(stay) <
          (least_share - sample_reserve) * static_cast<double>(line.samples.size())) {
        continue;
      }
      IdVector<EdgeId, EdgeId> images = match_edges(surface, surface, turn, radius);
      const double length = length_with_image(seen, images);
      const bool is_better =
          order > best.order ? clearly_more * length >= most : length > clearly_more * most;
      if (length >= least && length > 0.0 && is_better) {
        most = length;
        best = {order, std::move(images)};
      }
    }
  }
  return best.edge.empty() ? std::nullopt : std::optional(std::move(best));
}

}  // namespace ridgecraft::prepare
