// SPDX-License-Identifier: GPL-3.0-or-later
// The graph on which valleys run (docs/design/segmentation.md, "Arcs and jumps"): built once for the whole
// surface; a part uses those of its arcs that its facets carry.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "segment/surface/scaled_surface.hpp"

namespace ridgecraft::segment {

/// An arc from some vertex. Along an edge it exists in a part that has one of its facets, across an edge (the
/// straight line between the two opposite vertices, in the two triangles unfolded into one plane) in a part
/// that has both.
struct Arc {
  std::uint32_t target;
  float length;
};

struct VertexGraph {
  std::vector<Arc> arcs;  ///< of vertex v: arcs[first[v]] ... arcs[first[v + 1]], along edges first
  /// Of each arc the edge, as a side 3 f + k of one of its facets. Apart, since it is asked for at the
  /// borders of parts alone.
  std::vector<std::uint32_t> side;
  std::vector<std::uint32_t> first;   ///< one longer than there are vertices
  std::vector<std::uint32_t> across;  ///< of vertex v: its first arc across an edge
  double mean_length = 1.0;           ///< of an arc; 1 where all are points
};

/// Share of the tolerance that segmenting uses as `sagitta` below: far less than what counts as concave.
inline constexpr double arc_sagitta_share = 0.25;

/// `sagitta`: arcs across an edge that dip or rise by more than this from the straight line between their
/// ends are left out: a fold between two large triangles would otherwise be a bridge
/// of concavity 0 however deep it is. O(n).
[[nodiscard]] VertexGraph build_vertex_graph(const ScaledSurface& surface, double sagitta);

}  // namespace ridgecraft::segment
