// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/cutting/plane_cut.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include <Eigen/Eigenvalues>

#include "base/elementary.hpp"
#include "base/no_index.hpp"

namespace ridgecraft::segment {
namespace {

/// Vertices on which trials are measured: hulls of more say the same.
constexpr std::size_t most_sampled = 1500;
/// Where planes are tried, as shares of the part's extent along their normal.
constexpr std::array<double, 7> shares{0.06, 0.2, 0.35, 0.5, 0.65, 0.8, 0.94};

/// Axes of a symmetric matrix, the longest first.
std::array<Vec3, 3> principal_axes(const std::array<std::array<double, 3>, 3>& a) {
  Eigen::Matrix3d matrix;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      matrix(row, column) = a[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)];
    }
  }
  // Eigenvalues ascend.
  const Eigen::Matrix3d v = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(matrix).eigenvectors();
  std::array<Vec3, 3> axes{};
  for (int i = 0; i < 3; ++i) {
    axes[static_cast<std::size_t>(i)] = normalized(Vec3{v(0, 2 - i), v(1, 2 - i), v(2, 2 - i)});
  }
  return axes;
}

}  // namespace

PlaneCutter::PlaneCutter(const ScaledSurface& surface, const EdgeWeights& weights)
    : surface_(&surface),
      weights_(&weights),
      hulls_(surface.points),
      mark_(surface.vertex_count(), 0),
      node_(surface.facet_count(), no_index),
      side_(surface.facet_count(), 0) {}

double PlaneCutter::closed_volume(std::span<const std::uint32_t> facets) const {
  std::vector<bool> member(surface_->facet_count(), false);
  for (const std::uint32_t f : facets) {
    member[f] = true;
  }
  Vec3 rim;
  double count = 0.0;
  const auto& points = surface_->points;
  const auto open_side = [&](std::uint32_t f, unsigned k) {
    const std::uint32_t g = surface_->neighbors[f][k];
    return g == no_index || !member[g];
  };
  for (const std::uint32_t f : facets) {
    for (unsigned k = 0; k < 3; ++k) {
      if (open_side(f, k)) {
        rim += points[surface_->corners[f][k]];
        count += 1.0;
      }
    }
  }
  const Vec3 middle = count > 0.0 ? rim / count : points[surface_->corners[facets[0]][0]];
  double sum = 0.0;
  for (const std::uint32_t f : facets) {
    const auto& [a, b, c] = surface_->corners[f];
    sum += dot(points[a] - middle, cross(points[b] - middle, points[c] - middle));
  }
  return sum / 6.0;
}

double PlaneCutter::volume_of(std::span<const std::uint32_t> vertices) {
  hulls_.build(vertices, hull_);
  return hull_.volume(surface_->points);
}

double PlaneCutter::hull_volume(std::span<const std::uint32_t> facets) {
  take_part(facets);
  return volume_of(vertices_);
}

void PlaneCutter::take_part(std::span<const std::uint32_t> facets) {
  facets_.assign(facets.begin(), facets.end());
  vertices_.clear();
  ++current_;
  Vec3 sum;
  double area_sum = 0.0;
  const auto& points = surface_->points;
  for (const std::uint32_t f : facets_) {
    const auto& [a, b, c] = surface_->corners[f];
    const double area = length(cross(points[b] - points[a], points[c] - points[a]));
    sum += area / 3.0 * (points[a] + points[b] + points[c]);
    area_sum += area;
    for (const std::uint32_t v : surface_->corners[f]) {
      if (mark_[v] != current_) {
        mark_[v] = current_;
        vertices_.push_back(v);
      }
    }
  }
  std::sort(vertices_.begin(), vertices_.end());
  middle_ = area_sum > 0.0 ? sum / area_sum : points[vertices_[0]];
  std::array<std::array<double, 3>, 3> spread{};
  std::array<std::array<double, 3>, 3> normal_spread{};
  for (const std::uint32_t f : facets_) {
    const auto& [a, b, c] = surface_->corners[f];
    const double area = length(cross(points[b] - points[a], points[c] - points[a]));
    const Vec3 d = (points[a] + points[b] + points[c]) / 3.0 - middle_;
    const std::array<double, 3> x{d.x, d.y, d.z};
    const Vec3 n = surface_->facet_normal(f);
    const std::array<double, 3> y{n.x, n.y, n.z};
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) {
        spread[i][j] += area * x[i] * x[j];
        normal_spread[i][j] += area * y[i] * y[j];
      }
    }
  }
  axes_ = principal_axes(spread);
  normal_axes_ = principal_axes(normal_spread);
  sample_.clear();
  const std::size_t stride = vertices_.size() / most_sampled + 1;
  for (std::size_t i = 0; i < vertices_.size(); i += stride) {
    sample_.push_back(vertices_[i]);
  }
}

std::array<double, 2> PlaneCutter::extent(Vec3 direction) const {
  std::array<double, 2> range{INFINITY, -INFINITY};
  for (const std::uint32_t v : sample_) {
    const double at = dot(direction, surface_->points[v]);
    range = {std::min(range[0], at), std::max(range[1], at)};
  }
  return range;
}

std::vector<PlaneCutter::Trial> PlaneCutter::trials(bool stars) const {
  const auto& [x, y, z] = axes_;
  const double half = std::sqrt(0.5);
  std::vector<Vec3> directions{x,
                               y,
                               z,
                               half * (x + y),
                               half * (x - y),
                               half * (y + z),
                               half * (y - z),
                               half * (z + x),
                               half * (z - x)};
  if (!stars) {
    directions.insert(directions.end(), whole_axes_.begin(), whole_axes_.end());
  }
  std::vector<Trial> out;
  for (const Vec3 n : directions) {
    const auto [low, high] = extent(n);
    for (const double share : shares) {
      out.push_back({{{n, low + share * (high - low)}}});
    }
  }
  if (stars) {
    add_stars(axes_, out);
    add_stars(normal_axes_, out);
  }
  return out;
}

/// Planes through one axis, all around or only above a floor.
void PlaneCutter::add_stars(const std::array<Vec3, 3>& axes, std::vector<Trial>& out) const {
  Vec3 middle;
  for (const Vec3 axis : axes) {
    const auto [low, high] = extent(axis);
    middle += 0.5 * (low + high) * axis;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 axis = axes[i];
    const Vec3 u = axes[(i + 1) % 3];
    const Vec3 v = axes[(i + 2) % 3];
    const auto [low, high] = extent(axis);
    for (const int planes : {1, 2, 3, 4}) {
      Trial trial;
      for (int j = 0; j < planes; ++j) {
        const double angle = std::numbers::pi * (j + 0.5) / planes;
        const Vec3 n = elementary::cos(angle) * u + elementary::sin(angle) * v;
        trial.planes.push_back({n, dot(n, middle)});
      }
      if (planes > 1) {
        out.push_back(trial);
      }
      trial.floor = true;
      trial.planes.insert(trial.planes.begin(), CutPlane{});
      for (const double share : shares) {
        for (const double sign : {1.0, -1.0}) {
          const double offset = sign > 0.0 ? low + share * (high - low) : -(high - share * (high - low));
          trial.planes[0] = {sign * axis, offset};
          out.push_back(trial);
        }
      }
    }
  }
}

void PlaneCutter::measure(Trial& trial, double least) {
  std::map<std::uint32_t, std::vector<std::uint32_t>> sides;
  for (const std::uint32_t v : sample_) {
    std::uint32_t side = 0;
    for (std::size_t i = 0; i < trial.planes.size(); ++i) {
      if (dot(trial.planes[i].normal, surface_->points[v]) > trial.planes[i].offset) {
        side |= 1U << i;
      }
    }
    sides[trial.floor && (side & 1U) == 0 ? 0 : side].push_back(v);
  }
  double volume = 0.0;
  for (const auto& [side, vertices] : sides) {
    volume += volume_of(vertices);
  }
  trial.gain = volume_ - volume - least * static_cast<double>(sides.size() - 1);
}

/// Sets a bit of side_ for the facets beyond the plane. Facets nearer to it than `reach` go where the border
/// is cheapest.
void PlaneCutter::label(const CutPlane& plane, double reach, std::uint32_t bit) {
  const auto& points = surface_->points;
  std::vector<std::uint32_t> band;
  const auto height = [&](std::uint32_t f) {
    const auto& [a, b, c] = surface_->corners[f];
    return dot(plane.normal, (points[a] + points[b] + points[c]) / 3.0) - plane.offset;
  };
  for (const std::uint32_t f : facets_) {
    const double h = height(f);
    side_[f] |= h > 0.0 ? bit : 0U;
    if (std::abs(h) < reach) {
      node_[f] = static_cast<std::uint32_t>(band.size());
      band.push_back(f);
    }
  }
  flow_.reset(static_cast<std::uint32_t>(band.size()));
  for (std::uint32_t i = 0; i < band.size(); ++i) {
    for (unsigned k = 0; k < 3; ++k) {
      const std::uint32_t g = surface_->neighbors[band[i]][k];
      if (g == no_index || side_[g] == no_index) {
        continue;
      }
      const std::int64_t capacity = surface_->same_group(band[i], g) ? MaximumFlow::infinite_capacity
                                                                     : weights_->capacity(3 * band[i] + k);
      if (node_[g] != no_index) {
        flow_.set_arc(i, k, node_[g], capacity);
      } else if ((side_[g] & bit) != 0) {
        flow_.add_source(i, capacity);
      } else {
        flow_.add_sink(i, capacity);
      }
    }
  }
  flow_.run();
  for (std::uint32_t i = 0; i < band.size(); ++i) {
    side_[band[i]] = (side_[band[i]] & ~bit) | (flow_.on_source_side(i) ? bit : 0U);
  }
  for (const std::uint32_t f : band) {
    node_[f] = no_index;
  }
}

std::vector<Facets> PlaneCutter::cut(Cutter& cutter, std::span<const std::uint32_t> facets, double least,
                                     double reach, bool stars) {
  take_part(facets);
  volume_ = volume_of(sample_);
  if (!(volume_ > least)) {
    return {Facets(facets.begin(), facets.end())};
  }
  const Trial* best = nullptr;
  std::vector<Trial> all = trials(stars);
  if (stars) {
    whole_axes_ = axes_;
  }
  for (Trial& trial : all) {
    measure(trial, least);
    if (trial.gain > 0.0 && (best == nullptr || trial.gain > best->gain)) {
      best = &trial;
    }
  }
  if (best == nullptr) {
    return {Facets(facets.begin(), facets.end())};
  }
  std::fill(side_.begin(), side_.end(), no_index);
  for (const std::uint32_t f : facets_) {
    side_[f] = 0;
  }
  for (std::uint32_t i = 0; i < best->planes.size(); ++i) {
    label(best->planes[i], reach, 1U << i);
  }
  if (best->floor) {
    for (const std::uint32_t f : facets_) {
      side_[f] = (side_[f] & 1U) == 0 ? 0 : side_[f];
    }
  }
  return cutter.components(facets_, side_);
}

}  // namespace ridgecraft::segment
