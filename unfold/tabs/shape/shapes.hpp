// SPDX-License-Identifier: GPL-3.0-or-later
// The shapes that a glue tab may have on one side of a cut, given what stands around it.
//
// Everything here is in the frame of the side: the base runs from (0, 0) to (length, 0), the tab grows
// towards positive y, its own face lies below. The face that the tab is glued behind occupies, laid flat over
// the edge, the same ground above the base; so "inside the target" is a matter of the same plane.
#pragma once

#include <cstdint>
#include <vector>

#include "unfold/net/options.hpp"
#include "unfold/tabs/shape/convex_shape.hpp"
#include "unfold/tabs/shape/trimming.hpp"

namespace ridgecraft::unfold {

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

}  // namespace ridgecraft::unfold
