// SPDX-License-Identifier: GPL-3.0-or-later
// Lines as a set of points: whether another line lies on them, however the two are divided into segments.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "base/vector.hpp"
#include "verify/geometry/box_finder.hpp"

namespace ridgecraft::verify {

struct Segment {
  Vec2 a;
  Vec2 b;

  [[nodiscard]] double length() const { return ridgecraft::length(b - a); }
};

/// Distance of a point from a segment.
[[nodiscard]] double distance(Vec2 p, const Segment& s);

/// What of a segment lies on no line of a set.
struct Bare {
  double length = 0.0;  ///< of all such stretches together, mm
  Vec2 middle;          ///< of the first one
};

/// Built once in O(n log n).
class LineSet {
 public:
  LineSet() : LineSet(std::vector<Segment>()) {}
  explicit LineSet(std::vector<Segment> lines);

  [[nodiscard]] bool empty() const { return lines_.empty(); }

  /// The stretches of the segment that are farther than the tolerance from every line; nothing if there is
  /// none. About O(log n) and the lines nearby.
  [[nodiscard]] std::optional<Bare> bare(const Segment& segment, double tolerance) const;

  /// Distance of a point from the nearest line, or nothing where all are farther away than `reach`.
  [[nodiscard]] std::optional<double> distance_to(Vec2 p, double reach) const;

 private:
  std::vector<Segment> lines_;
  BoxFinder tree_;
};

}  // namespace ridgecraft::verify
