// SPDX-License-Identifier: GPL-3.0-or-later
// Some of a list of points, found by place.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "base/boxes.hpp"
#include "base/vector.hpp"

namespace ridgecraft::prepare {

/// The number of none of them.
inline constexpr std::uint32_t no_point = 0xffffffffU;

/// A tree of boxes over the points with these numbers, each once. The points must outlive it.
class NearbyPoints {
 public:
  /// O(n log n).
  NearbyPoints(const std::vector<Vec3>& points, std::vector<std::uint32_t> numbers)
      : points_(&points),
        numbers_(std::move(numbers)),
        tree_(
            numbers_.size(),
            [&](std::uint32_t i) {
              return Box3{points[numbers_[i]], points[numbers_[i]]};
            },
            [&](std::uint32_t i) { return points[numbers_[i]]; }) {}

  /// The nearest point within the radius, no_point where there is none. Of several at one distance it is any,
  /// but always the same.
  [[nodiscard]] std::uint32_t nearest(Vec3 p, double radius) const {
    double least = radius * radius;
    std::uint32_t best = no_point;
    search(
        p, [&](double distance) { return distance <= least; },
        [&](std::uint32_t i) {
          const Vec3 d = (*points_)[i] - p;
          if (dot(d, d) <= least) {
            least = dot(d, d);
            best = i;
          }
        });
    return best;
  }

  /// Calls visit(number) for the points of all leaves that enter(squared distance of their box) lets in,
  /// those near `from` first; what enter() says may change on the way.
  template <class Enter, class Visit>
  void search(Vec3 from, Enter enter, Visit visit) const {
    struct Nothing {};
    static_cast<void>(tree_.nearest_first(
        from, Nothing{}, [&](Nothing, std::uint32_t, double distance) { return enter(distance); },
        [&](Nothing, std::uint32_t place) { visit(numbers_[tree_.order()[place]]); }));
  }

 private:
  const std::vector<Vec3>* points_;
  std::vector<std::uint32_t> numbers_;
  BoxTree<Box3> tree_;
};

}  // namespace ridgecraft::prepare
