// SPDX-License-Identifier: GPL-3.0-or-later
// Points at one place become one point, and corners on a neighbour's side are set into it. Private to mesh/.
#pragma once

#include "base/context.hpp"
#include "mesh/model/soup.hpp"
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

/// Where border points lie within `distance` of a border edge, and another triangle's border edge runs along
/// a part of it, the edge's triangle is divided at them, so that the seam closes. Returns how many points
/// were set into edges. A border point must also be nearer than near_of_edge (weld.hpp) of its own border
/// edges. `uses`: those of the list's edges, before and after. O(n log n) where few points lie on one edge.
std::size_t join_t_junctions(TriangleList& list, std::vector<EdgeUse>& uses, double distance,
                             const Context& context);

}  // namespace ridgecraft::mesh
