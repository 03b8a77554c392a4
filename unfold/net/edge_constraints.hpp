// SPDX-License-Identifier: GPL-3.0-or-later
// Edges that a user wants cut or kept together.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/context.hpp"
#include "mesh/model/surface.hpp"
#include "prepare/prepared/panels.hpp"

namespace ridgecraft::unfold {

/// What a user wants of an edge of the surface, or its faces do.
enum class EdgeConstraint : std::uint8_t {
  none,
  cut,   ///< never a fold
  keep,  ///< a fold
  band,  ///< a fold: it lies across a wall that goes round, and stays one strip (pieces/kept_edges.hpp)
};
using EdgeConstraints = IdVector<EdgeId, EdgeConstraint>;  ///< per edge of a surface, or empty

/// From a point to another, in the surface's frame.
using Segment = std::array<Vec3, 2>;

/// How many of the segments of one kind came to what; together they are all.
struct SegmentCount {
  std::size_t found = 0;  ///< on edges that may be cut or kept
  std::size_t flat = 0;   ///< inside a flat region, where there is nothing to cut or to keep
  std::size_t lost = 0;   ///< on no edge of the surface
};

/// Constraints for edges, and how many segments found theirs.
struct MatchedSegments {
  EdgeConstraints constraints;
  SegmentCount cut, keep;  ///< what became of those to be cut, and of those to be kept
};

/// Constraints for the edges on which segments lie: those of which half or more is covered by segments along
/// them, so that points may have been added to an edge or taken from it since. What is to be cut and kept is
/// cut. O((n + m) log (n + m)) for n edges and m segments, but for those that cross many.
[[nodiscard]] MatchedSegments match_segments(const mesh::Surface& surface, const prepare::Panels& panels,
                                             std::span<const Segment> cut, std::span<const Segment> keep,
                                             const Context& context);

}  // namespace ridgecraft::unfold
