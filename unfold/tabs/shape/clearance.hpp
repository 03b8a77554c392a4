// SPDX-License-Identifier: GPL-3.0-or-later
// How far a tab keeps from faces and other tabs: the one rule, whatever the shapes are made of.
#pragma once

#include "unfold/tabs/shape/convex_shape.hpp"

namespace ridgecraft::unfold {

/// Near a corner of its base a tab comes close to its neighbours inevitably: those that share the corner keep
/// the clearance from this height upwards only, mm.
inline constexpr double corner_zone_mm = 1.0;

/// The part of a tab that keeps the clearance from what shares a corner of its base; empty where the tab is
/// lower. In the frame of shapes.hpp.
[[nodiscard]] inline ConvexShape above_corner_zone(const ConvexShape& tab) {
  return clipped(tab, {{0.0, 1.0}, corner_zone_mm});
}

/// Does a tab keep `clearance_mm` from a face or a tab? Both are asked whether they are at least `least` mm
/// apart (negative: they may touch): whole_apart(least) of the whole shapes; upper_apart(least), only where
/// they share a corner of the base, of the tab above the corner zone and, if the other is a tab, of its part
/// above its own.
///
/// Two forms of shapes are asked, and differ on purpose: the tabs of the result are polygons of any form
/// whose distance is exact (apart), while a search asks for thousands of quadrilaterals with ready normals
/// and gives away what two near corners would leave (walls_apart). What the second calls clear is clear for
/// the first.
template <class WholeApart, class UpperApart>
[[nodiscard]] bool keeps_clear(bool share_corner, double clearance_mm, WholeApart whole_apart,
                               UpperApart upper_apart) {
  if (!share_corner) {
    return whole_apart(clearance_mm);
  }
  return whole_apart(-touching_mm) && upper_apart(clearance_mm);
}

}  // namespace ridgecraft::unfold
