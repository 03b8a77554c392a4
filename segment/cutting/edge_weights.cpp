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
  const Vec3 n = s.facet_normal(f);
  const Vec3 m = s.facet_normal(g);
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

EdgeWeights::EdgeWeights(const ScaledSurface& s, const Rules& rules, std::span<const std::uint32_t> label)
    : surface_(&s), folds_by_length_(rules.folds_by_length), kind_(3 * s.facet_count(), EdgeKind::rim) {
  const double flattest_cosine = folds_by_length_ ? dead_zone_cosine : no_dead_zone;
  double length_sum = 0.0;
  double smoothness_sum = 0.0;
  std::size_t edges = 0;
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
      const bool concave = is_concave(s, f, g, flattest_cosine);
      kind_[side] = kind_[3 * g + j] = at_border(s, label, f, g)
                                           ? (concave ? EdgeKind::drawn_in_hollow : EdgeKind::drawn)
                                           : (concave ? EdgeKind::hollow : EdgeKind::smooth);
      length_sum += s.side_length(side);
      smoothness_sum += smoothness(side);
      ++edges;
    }
  }
  if (edges > 0) {
    const auto count = static_cast<double>(edges);
    mean_length_ = length_sum > 0.0 ? length_sum / count : 1.0;
    mean_smoothness_ = smoothness_sum / count;
  }
}

std::int64_t EdgeWeights::capacity(std::size_t side) const {
  if (kind_[side] == EdgeKind::rim) {
    return 0;
  }
  const double fold = alpha * smoothness(side) / mean_smoothness_;
  const double relative_length = surface_->side_length(side) / mean_length_;
  const double weight =
      folds_by_length_ ? (fold + 1.0 - alpha) * relative_length : fold + (1.0 - alpha) * relative_length;
  return std::llround(capacity_steps * std::clamp(weight, least_weight, largest_weight));
}

EdgeWeights weigh_edges(const ScaledSurface& s, const Rules& rules, std::span<const std::uint32_t> label) {
  return {s, rules, label};
}

}  // namespace ridgecraft::segment
