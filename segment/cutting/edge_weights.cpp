// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/cutting/edge_weights.hpp"

#include <algorithm>
#include <cmath>

namespace ridgecraft::segment {
namespace {

/// Share of the fold in the weight; the rest is length alone.
constexpr double alpha = 0.8;
/// More than any cosine: no edge is too flat to be concave.
constexpr double no_dead_zone = 2.0;
/// cos 5 degrees: flatter concave edges are noise of the mesh, no place to cut.
constexpr double dead_zone_cosine = 0.99619469809174555;
/// Relative height of the neighbour's centroid above a facet from which the edge is concave: rounding of
/// centroids.
constexpr double rise_tolerance = 1e-9;
constexpr double least_weight = 1e-6;
constexpr double capacity_steps = 0x1p20;
/// Keeps the sum over all sides of the largest mesh below 2^63.
constexpr double largest_weight = 1e6;

bool is_concave(const ScaledSurface& s, std::uint32_t f, std::uint32_t g, double flattest_cosine) {
  const Vec3 n = s.facet_normals[f];
  const Vec3 m = s.facet_normals[g];
  if (n == Vec3{} || m == Vec3{} || dot(n, m) >= flattest_cosine) {
    return false;
  }
  const auto centroid = [&](std::uint32_t facet) {
    const auto& [a, b, c] = s.corners[facet];
    return (s.points[a] + s.points[b] + s.points[c]) / 3.0;
  };
  const Vec3 over = centroid(g) - centroid(f);
  return dot(n, over) > rise_tolerance * length(over);
}

/// Do two facets have labels that differ? Facets that close holes have none.
bool at_border(const ScaledSurface& s, std::span<const std::uint32_t> label, std::uint32_t f,
               std::uint32_t g) {
  if (label.empty()) {
    return false;
  }
  const auto number = [&](std::uint32_t facet) {
    return facet < s.face_of.size() ? s.face_of[facet] : facet;
  };
  const std::uint32_t a = number(f);
  const std::uint32_t b = number(g);
  return a < label.size() && b < label.size() && label[a] != label[b];
}

}  // namespace

EdgeWeights weigh_edges(const ScaledSurface& s, const Rules& rules, std::span<const std::uint32_t> label) {
  const double flattest_cosine = rules.folds_by_length ? dead_zone_cosine : no_dead_zone;
  EdgeWeights w;
  const std::size_t sides = 3 * s.facet_count();
  w.kind.assign(sides, EdgeKind::rim);
  w.capacity.assign(sides, 0);
  std::vector<std::uint32_t> first_side;
  std::vector<std::uint32_t> second_side;
  first_side.reserve(sides / 2);
  second_side.reserve(sides / 2);
  double length_sum = 0.0;
  double smoothness_sum = 0.0;
  for (std::uint32_t f = 0; f < s.facet_count(); ++f) {
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t g = s.neighbors[f][k];
      if (g == none || g < f) {
        continue;
      }
      const std::uint32_t to = s.corners[f][(k + 1) % 3];
      std::uint32_t j = 0;
      while (j < 2 && !(s.neighbors[g][j] == f && s.corners[g][j] == to)) {
        ++j;
      }
      const std::uint32_t side = 3 * f + k;
      const std::uint32_t twin = 3 * g + j;
      const bool concave = is_concave(s, f, g, flattest_cosine);
      w.kind[side] = w.kind[twin] = at_border(s, label, f, g)
                                        ? (concave ? EdgeKind::drawn_in_hollow : EdgeKind::drawn)
                                        : (concave ? EdgeKind::hollow : EdgeKind::smooth);
      length_sum += s.side_length(side);
      smoothness_sum += w.smoothness(side);
      first_side.push_back(side);
      second_side.push_back(twin);
    }
  }
  if (first_side.empty()) {
    return w;
  }
  const auto count = static_cast<double>(first_side.size());
  const double mean_length = length_sum > 0.0 ? length_sum / count : 1.0;
  const double mean_smoothness = smoothness_sum / count;
  for (std::size_t e = 0; e < first_side.size(); ++e) {
    const std::uint32_t side = first_side[e];
    const double fold = alpha * w.smoothness(side) / mean_smoothness;
    const double relative_length = s.side_length(side) / mean_length;
    const double weight = rules.folds_by_length ? (fold + 1.0 - alpha) * relative_length
                                                : fold + (1.0 - alpha) * relative_length;
    w.capacity[side] = w.capacity[second_side[e]] =
        std::llround(capacity_steps * std::clamp(weight, least_weight, largest_weight));
  }
  return w;
}

}  // namespace ridgecraft::segment
