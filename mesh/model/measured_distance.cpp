// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/model/measured_distance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace ridgecraft::mesh {
namespace {

/// What could still be added to the distance, as a share of it, and as one of the samples' spacing.
constexpr double close_enough = 0.01;
constexpr double close_enough_to_nothing = 0.005;
/// Parts that are divided each way.
constexpr std::size_t most_divided = 20000;
/// Between looks whether the work is to stop.
constexpr std::size_t often = 4096;

/// A part of a face, and how far from the other surface its points may be at most.
struct Part {
  std::array<Vec3, 3> corners;
  FaceId nearest;  ///< face of the other surface, to the middle
  double bound = 0.0;
  std::size_t number = 0;  ///< the first of equal bounds goes first, with every standard library
};

bool is_lower(const Part& a, const Part& b) {
  return std::pair(a.bound, b.number) < std::pair(b.bound, a.number);
}

/// One way. `greatest`: what is known already.
class Search {
 public:
  Search(const SurfaceTree& from, const SurfaceTree& to, double& greatest, const Context& context)
      : to_(to), spacing_(from.spacing()), greatest_(greatest), context_(context) {
    const Surface& surface = from.surface();
    FaceId nearest;
    for (const FaceId f : ids<FaceId>(surface.face_count())) {
      const auto [a, b, c] = surface.vertices(f);
      const std::array<Vec3, 3> corners{surface.point(a), surface.point(b), surface.point(c)};
      // Of smaller ones the samples tell enough.
      if (longest_side(corners).length > spacing_) {
        nearest = add(corners, nearest);
      }
    }
  }

  void run() {
    for (std::size_t divided = 0; !parts_.empty() && divided < most_divided; ++divided) {
      std::pop_heap(parts_.begin(), parts_.end(), is_lower);
      const Part part = parts_.back();
      parts_.pop_back();
      if (!matters(part.bound)) {
        return;
      }
      divide(part);
    }
  }

 private:
  struct Side {
    std::size_t number = 0;  ///< from this corner to the next
    double length = 0.0;
  };

  static Side longest_side(const std::array<Vec3, 3>& corners) {
    Side longest;
    for (std::size_t k = 0; k < 3; ++k) {
      const double side = length(corners[(k + 1) % 3] - corners[k]);
      if (side > longest.length) {
        longest = {k, side};
      }
    }
    return longest;
  }

  [[nodiscard]] bool matters(double bound) const {
    return bound > (1.0 + close_enough) * greatest_ + close_enough_to_nothing * spacing_;
  }

  void divide(const Part& part) {
    const std::size_t k = longest_side(part.corners).number;
    const Vec3 a = part.corners[k];
    const Vec3 b = part.corners[(k + 1) % 3];
    const Vec3 c = part.corners[(k + 2) % 3];
    const Vec3 middle = 0.5 * (a + b);
    add({a, middle, c}, part.nearest);
    add({middle, b, c}, part.nearest);
  }

  /// Looks how far its centre is; no point is farther by more than its way to the centre, and none is farther
  /// from the face that is nearest there, which is convex, than the farthest corner is. `nearest`: a guess
  /// which one that is, or none; returns it.
  FaceId add(const std::array<Vec3, 3>& corners, FaceId nearest) {
    if (++places_ % often == 0) {
      context_.check();
    }
    const Vec3 centre = (corners[0] + corners[1] + corners[2]) / 3.0;
    const double distance = to_.distance(centre, 0.0, nearest);
    if (!nearest.valid()) {
      return nearest;
    }
    greatest_ = std::max(greatest_, distance);
    double radius = 0.0;
    double from_face = 0.0;
    for (const Vec3 corner : corners) {
      radius = std::max(radius, length(corner - centre));
      from_face = std::max(from_face, to_.distance_of(nearest, corner));
    }
    const double bound = std::min(distance + radius, from_face);
    if (matters(bound)) {
      parts_.push_back({corners, nearest, bound, places_});
      std::push_heap(parts_.begin(), parts_.end(), is_lower);
    }
    return nearest;
  }

  const SurfaceTree& to_;
  double spacing_;
  double& greatest_;
  const Context& context_;
  std::size_t places_ = 0;   ///< that were looked at
  std::vector<Part> parts_;  ///< a heap
};

}  // namespace

double measured_distance(const SurfaceTree& a, const SurfaceTree& b, const Context& context) {
  double greatest = greatest_distance(a, b, INFINITY, context);
  for (const auto& [from, to] : {std::pair(&a, &b), std::pair(&b, &a)}) {
    Search(*from, *to, greatest, context).run();
  }
  return greatest;
}

}  // namespace ridgecraft::mesh
