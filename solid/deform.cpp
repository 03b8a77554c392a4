// SPDX-License-Identifier: GPL-3.0-or-later
// Mean value coordinates of points in a closed triangle mesh.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/elementary.hpp"
#include "base/error.hpp"
#include "solid/solid.hpp"

namespace ridgecraft::solid {
namespace {

/// Nearer to a cage vertex or a triangle's plane than this, relative to the cage's size, counts as on it. The
/// formula loses all digits at about 1e-8.
constexpr double on_cage = 1e-9;

/// Where one point goes.
class MeanValue {
 public:
  MeanValue(const Body& before, const Body& after)
      : before_(before), after_(after), distance_(before.points.size()), direction_(before.points.size()) {
    Box3 bounds;
    for (const Vec3 p : before.points) {
      bounds.add(p);
    }
    near_ = on_cage * bounds.diagonal();
  }

  Vec3 operator()(Vec3 x) {
    for (std::size_t v = 0; v < distance_.size(); ++v) {
      const Vec3 to = before_.points[v] - x;
      distance_[v] = length(to);
      if (distance_[v] <= near_) {
        return after_.points[v];
      }
      direction_[v] = to / distance_[v];
    }
    Vec3 sum{};
    double total = 0.0;
    for (const auto& triangle : before_.triangles) {
      std::array<double, 3> weight{};
      const Seen seen = weights(triangle, weight);
      if (seen == Seen::inside) {
        return weighted(triangle, weight) / (weight[0] + weight[1] + weight[2]);
      }
      if (seen == Seen::apart) {
        sum += weighted(triangle, weight);
        total += weight[0] + weight[1] + weight[2];
      }
    }
    return sum / total;
  }

 private:
  enum class Seen { inside, edge_on, apart };

  [[nodiscard]] Vec3 weighted(const std::array<std::uint32_t, 3>& t, const std::array<double, 3>& w) const {
    return w[0] * after_.points[t[0]] + w[1] * after_.points[t[1]] + w[2] * after_.points[t[2]];
  }

  /// The spherical triangle's share for each corner (figure 4 of the paper).
  Seen weights(const std::array<std::uint32_t, 3>& t, std::array<double, 3>& weight) const {
    std::array<double, 3> side{};  // arcs of the spherical triangle, opposite to the corners
    double half = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      const double chord = length(direction_[t[(i + 1) % 3]] - direction_[t[(i + 2) % 3]]);
      side[i] = 2.0 * elementary::asin(std::fmin(1.0, 0.5 * chord));
      half += 0.5 * side[i];
    }
    if (std::numbers::pi - half < on_cage) {  // the point is in the triangle
      for (std::size_t i = 0; i < 3; ++i) {
        weight[i] = elementary::sin(side[i]) * distance_[t[(i + 1) % 3]] * distance_[t[(i + 2) % 3]];
      }
      return Seen::inside;
    }
    const double volume = dot(direction_[t[0]], cross(direction_[t[1]], direction_[t[2]]));
    const double sign = volume < 0.0 ? -1.0 : 1.0;
    std::array<double, 3> cosine{};
    std::array<double, 3> sine{};
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      const std::size_t k = (i + 2) % 3;
      cosine[i] = 2.0 * elementary::sin(half) * elementary::sin(half - side[i]) /
                      (elementary::sin(side[j]) * elementary::sin(side[k])) -
                  1.0;
      cosine[i] = std::clamp(cosine[i], -1.0, 1.0);
      sine[i] = sign * std::sqrt(1.0 - cosine[i] * cosine[i]);
      if (std::fabs(sine[i]) <= on_cage) {
        return Seen::edge_on;  // in the triangle's plane, outside it: no weight
      }
    }
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      const std::size_t k = (i + 2) % 3;
      weight[i] = (side[i] - cosine[j] * side[k] - cosine[k] * side[j]) /
                  (distance_[t[i]] * elementary::sin(side[j]) * sine[k]);
    }
    return Seen::apart;
  }

  const Body& before_;
  const Body& after_;
  std::vector<double> distance_;
  std::vector<Vec3> direction_;
  double near_ = 0.0;
};

}  // namespace

std::vector<Vec3> deform(std::span<const Vec3> points, const Body& before, const Body& after,
                         const Context& context) {
  RIDGECRAFT_ASSERT(before.points.size() == after.points.size() && before.triangles == after.triangles);
  MeanValue moved(before, after);
  std::vector<Vec3> result;
  result.reserve(points.size());
  for (const Vec3 p : points) {
    if (result.size() % 64 == 0) {
      context.check();
    }
    result.push_back(moved(p));
  }
  return result;
}

}  // namespace ridgecraft::solid
