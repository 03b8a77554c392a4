// SPDX-License-Identifier: GPL-3.0-or-later
// What of one surface lies on what of another after a motion: vertices, edges, faces.
#pragma once

#include "base/id.hpp"
#include "mesh/model/surface.hpp"
#include "prepare/symmetry/isometry.hpp"

namespace ridgecraft::prepare {

/// For each vertex, edge and face of one surface the partner on another one (or on the same), none where
/// there is none. No two have the same partner.
struct Correspondence {
  IdVector<VertexId, VertexId> vertex;
  IdVector<EdgeId, EdgeId> edge;
  IdVector<FaceId, FaceId> face;
  /// Greatest distance of a vertex' image from its partner; infinite where a vertex has none.
  double farthest = 0.0;
  /// Every face has a partner, neighbours have neighbours, and the surfaces have equally many faces: faces
  /// and their connections are the same but for their numbers. Corner k of a face belongs to the corner of
  /// its partner that has the partner of its vertex.
  bool whole = false;
};

/// Partners of vertices are the nearest ones to each other (that of the image, and that of the inverse image)
/// within `radius`. A face's partner has the partners of its corners, and the same outside. Where several
/// vertices lie at one place the faces tell them apart. Edges follow the faces where these have partners, and
/// match_edges() elsewhere. O(n log n).
[[nodiscard]] Correspondence correspond(const mesh::Surface& from, const mesh::Surface& to,
                                        const Isometry& isometry, double radius);

/// For each edge of `from` the one of `to` that its image lies on, both ends within `radius` (and a third of
/// its length), so that neither edge has a better partner; none where there is none. Edges in one place are
/// told apart by their faces' normals. What lies inside flat regions may be triangulated differently: the
/// edges around them find each other all the same. O(n log n).
[[nodiscard]] IdVector<EdgeId, EdgeId> match_edges(const mesh::Surface& from, const mesh::Surface& to,
                                                   const Isometry& isometry, double radius);

}  // namespace ridgecraft::prepare
