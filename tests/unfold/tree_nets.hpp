// SPDX-License-Identifier: GPL-3.0-or-later
// Nets for tests, made without the unfolder: a spanning forest of the faces is laid flat, overlap or not.
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/model/surface.hpp"
#include "prepare/prepared/panels.hpp"
#include "support/shapes.hpp"
#include "unfold/net/nets.hpp"

namespace ridgecraft::test {

/// A surface and a net of it.
struct Sample {
  mesh::Surface surface;
  prepare::Panels panels;
  unfold::Nets nets;
};

/// The surface's edges in the order in which a spanning tree takes them as folds.
using FoldOrder = std::vector<EdgeId>;

/// Folds as a breadth-first search from face 0 of each component meets them.
[[nodiscard]] FoldOrder breadth_first(const mesh::Surface& surface);
/// A random order.
[[nodiscard]] FoldOrder random_order(const mesh::Surface& surface, std::uint64_t seed);
/// Cuts go along the edge that climbs steepest from each vertex in a random direction (Schlickenrieder 1997);
/// convex solids hardly ever overlap.
[[nodiscard]] FoldOrder steepest_edge(const mesh::Surface& surface, std::uint64_t seed);

/// Kruskal: edges become folds in the given order unless they close a circle or `keep_cut` says no. Every
/// component of the folds is a piece, every other edge with two faces a join. No tabs.
[[nodiscard]] unfold::Nets lay_out(const mesh::Surface& surface, const FoldOrder& order,
                                   const std::vector<EdgeId>& keep_cut = {});

/// Convex hull of `count` random points of the unit sphere.
[[nodiscard]] mesh::Surface random_hull(int count, std::uint64_t seed);
/// A flat square grid of 2 k * k triangles with side 1 per square, from (0, 0) to (k, k).
[[nodiscard]] mesh::Surface flat_grid(int k);
/// The edge between two vertices.
[[nodiscard]] EdgeId edge_between(const mesh::Surface& surface, VertexId a, VertexId b);

/// Depth to which two convex counterclockwise polygons penetrate each other: the shortest translation that
/// separates them; negative where they are apart. Unfolding notes, section 2.1.
[[nodiscard]] double penetration(const std::vector<Vec2>& a, const std::vector<Vec2>& b);

/// Do two faces of a piece overlap by more than a thousandth of a millimetre? All pairs.
[[nodiscard]] bool faces_overlap(const unfold::Nets& nets);

}  // namespace ridgecraft::test
