// SPDX-License-Identifier: GPL-3.0-or-later
// Points at one place become one point. Private to mesh/.
#pragma once

#include "base/context.hpp"
#include "mesh/model/repair_report.hpp"
#include "mesh/repair/polygon_list.hpp"

namespace ridgecraft::mesh {

/// A point lies on another one or on an edge only within this share of the shortest border edge at it: where
/// one far-off point makes the diagonal large, a share of the diagonal is more than all the rest of the
/// model.
constexpr double near_of_edge = 0.1;

/// Joins points with equal coordinates, everywhere; the first of them stays. Returns how many went. O(n log
/// n).
std::size_t join_equal_points(PolygonList& list);

/// Joins points closer than `distance` that both lie on the border (on a polygon side that no other polygon
/// has), nearest first, but never two corners of one polygon. Points farther apart than a tenth of the
/// shortest border side at either of them stay apart, too. O(n log^2 n). Returns how many went.
std::size_t join_border_points(PolygonList& list, double distance, const Context& context);

}  // namespace ridgecraft::mesh
