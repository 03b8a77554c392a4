// SPDX-License-Identifier: GPL-3.0-or-later
// Points at one place become one point. Private to mesh/.
#pragma once

#include "mesh/context.hpp"
#include "mesh/polygon_list.hpp"
#include "mesh/repair_report.hpp"

namespace ridgecraft::mesh {

/// Joins points with equal coordinates, everywhere; the first of them stays. Returns how many went. O(n log
/// n).
std::size_t join_equal_points(PolygonList& list);

/// Joins points closer than `distance` that both lie on the border (on a polygon side that no other polygon
/// has), nearest first, but never two corners of one polygon. O(n log n) for what files hold. Returns how
/// many went.
std::size_t join_border_points(PolygonList& list, double distance, const Context& context);

}  // namespace ridgecraft::mesh
