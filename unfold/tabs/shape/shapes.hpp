// SPDX-License-Identifier: GPL-3.0-or-later
// What stands in a tab's way, and how a tab is cut back until it is clear. In the frame of shapes.hpp.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "unfold/net/options.hpp"
#include "unfold/tabs/shape/convex_shape.hpp"

namespace ridgecraft::unfold {

/// A tab that is as high as this over half of its edge holds, mm (issue of users: lower ones tear off).
inline constexpr double usable_height_mm = 3.0;

/// Something that a tab must not run into.
struct Obstacle {
  enum class Kind : std::uint8_t {
    thing,          ///< a face or a tab: keep the clearance
    at_base_left,   ///< the same, but it shares the base's corner at (0, 0): may be touched there
    at_base_right,  ///< shares the corner at (length, 0)
    at_both,        ///< shares both corners
    target_edge,    ///< outline of the face that the tab is glued behind: may be touched
  };
  ConvexShape shape;
  Kind kind = Kind::thing;
};

/// Does an obstacle of this kind share the corner of the base at (0, 0)?
[[nodiscard]] bool shares_left(Obstacle::Kind kind);
/// ... at (length, 0)?
[[nodiscard]] bool shares_right(Obstacle::Kind kind);
/// Of a face or a tab that shares the base's corner at (0, 0), at (length, 0), or neither.
[[nodiscard]] Obstacle::Kind kind_sharing(bool left, bool right);

/// How far the faces that one tab is glued behind may be bent against each other in all, radians (20
/// degrees): a strip of card follows them.
inline constexpr double most_bend_of_tab = 0.3490658503988659;
/// A side of the target that a tab enters by no more than this is neither in its way nor gone over, mm:
/// rounding doesn't decide what lies behind it.
inline constexpr double just_touching_mm = 1e-6;
/// A target lower than this has no inside to be glued behind, mm: its outline can't be told from the base.
inline constexpr double least_target_mm = 1e-5;
/// Stands for the outline of such a target over an edge of this length: nothing fits under it.
[[nodiscard]] inline Obstacle no_target(double length) {
  return {{{0.0, least_target_mm}, {length, least_target_mm}}, Obstacle::Kind::target_edge};
}

/// Does the tab keep clear of the obstacle as its kind asks?
[[nodiscard]] bool clear_of(const ConvexShape& tab, const Obstacle& obstacle, double clearance_mm);

/// The tab cut back by the straight line that keeps its base and the most of it, so that it is clear of the
/// obstacle; empty when there is none. The result lies inside `tab`, so it stays clear of whatever `tab` was
/// clear of.
[[nodiscard]] ConvexShape trimmed(const ConvexShape& tab, const Obstacle& obstacle, double clearance_mm);

// The shapes that a glue tab may have on one side of a cut, given what stands around it.
//
// Everything here is in the frame of the side: the base runs from (0, 0) to (length, 0), the tab grows
// towards positive y, its own face lies below. The face that the tab is glued behind occupies, laid flat over
// the edge, the same ground above the base; so "inside the target" is a matter of the same plane.

/// A tab's shape and how well it serves.
struct TabShape {
  ConvexShape outline;  ///< counterclockwise, first two corners on the base; empty: none
  bool usable = false;  ///< at least usable_height_mm high along at least half of the edge
  double cost = 0.0;    ///< 0 is as asked; see tab_costs
};

/// What a retreat from the tab that was asked for costs; only the order matters, and that a sum of small
/// retreats doesn't outweigh the next larger kind.
struct TabCosts {
  double lower = 1.0;    ///< per step of height
  double steeper = 4.0;  ///< per step of a side's angle
  double trimmed = 30.0;
  double leaning = 36.0;      ///< trimmed to the least that is usable
  double overhanging = 50.0;  ///< wider than its base or leaning over an end of it
  double other_side = 40.0;
  double part_of_edge = 80.0;
  double stacked = 6.0;  ///< two tabs behind one face that overlap there
  double low = 300.0;    ///< lower or narrower than usable
  double none = 1000.0;
};
inline constexpr TabCosts tab_costs;

/// Trapezoid over the base from `left` to `right` with side angles given by their cotangents.
[[nodiscard]] ConvexShape trapezoid(double left, double right, double height, double cot_left,
                                    double cot_right);

/// The part of an edge that a tab grows from, mm from the left end.
struct TabBase {
  double left = 0.0;
  double right = 0.0;
  double edge = 0.0;  ///< length of the whole edge
};

/// What is asked of a tab.
enum class TabNeed : std::uint8_t {
  usable,    ///< see is_usable
  anything,  ///< of the smallest size
};

/// The largest tab over the base among all obstacles: the steepest trapezoid, trimmed; where that isn't what
/// is needed, the same with sides that overhang. Empty as soon as it is less than needed. O(obstacles).
[[nodiscard]] ConvexShape largest_tab(const TabBase& base, const std::vector<Obstacle>& obstacles,
                                      const TabOptions& options, TabNeed need);

/// What no tab on an edge of this length can leave; empty where the edge is too short for any.
[[nodiscard]] ConvexShape widest_tab(double length, const TabOptions& options);

/// Usable shapes inside `largest`, best first: trapezoids as asked, lower, steeper, then `largest` trimmed in
/// the same manner, and some that lean to one end of the base so that a neighbour finds room at the other.
/// `length` is that of the whole edge. O(1).
[[nodiscard]] std::vector<TabShape> tab_shapes(const ConvexShape& largest, double length,
                                               const TabOptions& options);

/// Usable shapes that cover only a part of the edge, at least half of it, best first.
[[nodiscard]] std::vector<TabShape> partial_tab_shapes(double length, const std::vector<Obstacle>& obstacles,
                                                       const TabOptions& options);

/// The best shape where no usable one is to be had, of the whole base or of a part; its outline is empty if
/// there is none.
[[nodiscard]] TabShape low_tab_shape(double length, const std::vector<Obstacle>& obstacles,
                                     const TabOptions& options);

/// Is the tab at least usable_height_mm high along at least half of an edge of this length?
[[nodiscard]] bool is_usable(const ConvexShape& tab, double length, const TabOptions& options);

/// Can an edge of this length carry any tab at all, with nothing around it?
[[nodiscard]] bool long_enough(double length, const TabOptions& options);

/// How wide the top of a tab on an edge of this length is at least, mm.
[[nodiscard]] double least_top(double length, const TabOptions& options);

// The few tabs that a search tries on a side: no larger than usable, inside what the face behind them allows,
// in a form that is quickly tested against what stands around.

/// A convex polygon of n corners with the outward normals of its sides.
template <std::size_t n>
struct Walled {
  std::array<Vec2, n> corner;
  std::array<Vec2, n> normal;
  std::array<double, n> offset{};  ///< dot(normal, x) on the side

  /// From corners that are set, counterclockwise.
  void build_walls() {
    for (std::size_t i = 0; i < n; ++i) {
      const Vec2 along = corner[(i + 1) % n] - corner[i];
      const double size = length(along);
      normal[i] = size > 0.0 ? -perpendicular(along) / size : Vec2{};
      offset[i] = size > 0.0 ? dot(normal[i], corner[i]) : HUGE_VAL;
    }
  }
};

/// Do all corners of b lie at least `enough` beyond one side of a?
template <std::size_t n, std::size_t m>
[[nodiscard]] bool beyond_a_wall(const Walled<n>& a, const Walled<m>& b, double enough) {
  for (std::size_t i = 0; i < n; ++i) {
    const double least = a.offset[i] + enough;
    bool all = true;
    for (std::size_t k = 0; k < m && all; ++k) {
      all = dot(a.normal[i], b.corner[k]) >= least;
    }
    if (all) {
      return true;
    }
  }
  return false;
}

/// Are the polygons at least `gap` apart along a normal of either? Stricter than distance where two corners
/// are nearest.
template <std::size_t n, std::size_t m>
[[nodiscard]] bool walls_apart(const Walled<n>& a, const Walled<m>& b, double gap) {
  return beyond_a_wall(a, b, gap) || beyond_a_wall(b, a, gap);
}

/// A tab in the frame of shapes.hpp.
struct TabCandidate {
  Walled<4> whole;
  Walled<4> upper;        ///< what keeps the clearance from things that share a corner of the base
  bool at_left = false;   ///< reaches the corner at (0, 0)
  bool at_right = false;  ///< reaches the corner at (length, 0)
};

inline constexpr std::size_t most_candidates = 8;

/// Tabs inside `largest` (largest_tab over the whole edge, with nothing but the target as obstacle), the more
/// upright ones first; none where it is empty. At most most_candidates. O(1).
[[nodiscard]] std::vector<TabCandidate> tab_candidates(const ConvexShape& largest, double length,
                                                       const TabOptions& options);

}  // namespace ridgecraft::unfold
