// SPDX-License-Identifier: GPL-3.0-or-later
// Motions of space that keep lengths, mirrored ones among them; points found by place; lengths of edges as
// seen.
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "base/boxes.hpp"
#include "base/geometry.hpp"
#include "base/id.hpp"
#include "base/no_index.hpp"
#include "base/vector.hpp"
#include "mesh/model/surface.hpp"

namespace ridgecraft::prepare {

/// The plane of the points p with dot(p, normal) == offset. The normal has length 1, and its first component
/// that isn't 0 is positive, so one plane has one value.
struct MirrorPlane {
  Vec3 normal{1.0, 0.0, 0.0};
  double offset = 0.0;

  /// Signed distance of a point from the plane.
  [[nodiscard]] double height(Vec3 p) const { return dot(p, normal) - offset; }
  [[nodiscard]] Vec3 image(Vec3 p) const { return p - 2.0 * height(p) * normal; }
  [[nodiscard]] Vec3 foot(Vec3 p) const { return p - height(p) * normal; }
};

/// A motion, or a motion after mirroring: then the rows of its matrix have the determinant -1.
struct Isometry {
  Motion motion;
  bool mirrors = false;

  [[nodiscard]] Vec3 turn(Vec3 v) const { return motion.turn(v); }
  [[nodiscard]] Vec3 operator()(Vec3 p) const { return motion(p); }
  [[nodiscard]] Isometry inverse() const;
};

/// First b, then a.
[[nodiscard]] Isometry operator*(const Isometry& a, const Isometry& b);

[[nodiscard]] Isometry mirroring(const MirrorPlane& plane);

// Some of a list of points, found by place.

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

  /// The nearest point within the radius, no_index where there is none. Of several at one distance it is any,
  /// but always the same.
  [[nodiscard]] std::uint32_t nearest(Vec3 p, double radius) const {
    double least = radius * radius;
    std::uint32_t best = no_index;
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

// Where the area of a surface lies. It doesn't depend on how the surface is divided into triangles.

struct AreaFrame {
  Vec3 centre;
  std::array<Vec3, 3> axes;  ///< principal ones, the spread along them ascending
};

/// Linear.
[[nodiscard]] AreaFrame area_frame(const mesh::Surface& surface);

// The edges of a surface as people see them: how much of a model is symmetric is told by these.

/// Of each edge its length, in the surface's unit; 0 where it is folded by less than 0.1 degrees, as lines
/// within flat regions are. O(n).
[[nodiscard]] IdVector<EdgeId, double> seen_lengths(const mesh::Surface& surface);

/// Of the seen length of edges what has an image. O(n).
[[nodiscard]] double length_with_image(const IdVector<EdgeId, double>& seen,
                                       const IdVector<EdgeId, EdgeId>& images);

}  // namespace ridgecraft::prepare
