// SPDX-License-Identifier: GPL-3.0-or-later
// What stands in a tab's way, and how a tab is cut back until it is clear. In the frame of shapes.hpp.
#pragma once

#include <cstdint>

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

}  // namespace ridgecraft::unfold
