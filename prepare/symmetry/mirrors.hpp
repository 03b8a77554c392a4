// SPDX-License-Identifier: GPL-3.0-or-later
// Mirror planes of a surface, and what lies on what when it is mirrored.
//
//   find_mirrors(surface)            planes, best first, each with the map of vertices, edges and faces
//   for_mirrors(surface, use)        the same, one after the other, until one is of use
//   mirror_edges(surface, plane)     only the edges' partners: what cuts are carried over with
//
// Surfaces are taken whole. Of a component, a part or a piece make a surface of its own (part_of), which
// says where its vertices, edges and faces came from.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "base/id.hpp"
#include "mesh/model/surface.hpp"
#include "prepare/symmetry/correspondence.hpp"
#include "prepare/symmetry/isometry.hpp"

namespace ridgecraft::prepare {

/// How far a symmetric surface may be off, as shares of its largest extent.
struct SymmetryTolerance {
  /// Numbers of a file have six digits or 24 bits: what was made symmetric is so to a few units of the last.
  double exact = 5e-6;
  /// What was modelled by hand or scanned; hardly seen at 150 mm.
  double near = 5e-3;
};

/// A plane that a surface is mirrored onto itself at. Distances in the surface's unit.
struct Mirror {
  MirrorPlane plane;
  /// Each corner's image is at most so far from the surface. Of surfaces with more than 200,000 corners about
  /// 100,000 are looked at, and of exact planes all that have no partner.
  double deviation = 0.0;
  /// Every corner has a partner within SymmetryTolerance::exact (its place counts: triangles within flat
  /// regions may differ).
  bool exact = false;
  /// Partners within SymmetryTolerance::near, their own partners' partners. maps.whole: the faces and their
  /// connections are symmetric, too, whatever the deviation.
  Correspondence maps;
};

/// At most `most` planes, exact ones first, then by deviation. Planes that nearly lie in the whole surface
/// don't count. Finds every exact plane (of cubes and turned bodies, too, as long as `most` isn't reached)
/// and those nearly exact ones that are close to a principal axis of the surface or to an axis of
/// coordinates. Where triangles lie doesn't matter, only what they cover. O(n log n) for each plane and for
/// each candidate that isn't one at first sight.
[[nodiscard]] std::vector<Mirror> find_mirrors(const mesh::Surface& surface, std::size_t most = 16,
                                               const SymmetryTolerance& tolerance = {});

/// Calls use() for such planes until it returns true: the first exact one that is come upon, and after all of
/// these the others, by the deviation of some of their corners. Who needs one plane only has the others' maps
/// spared.
void for_mirrors(const mesh::Surface& surface, std::size_t most, const SymmetryTolerance& tolerance,
                 const std::function<bool(const Mirror&)>& use);

/// For each edge the edge that is its mirror image: itself where it lies on the plane or crosses it upright,
/// none where it has none (as inside flat regions that are triangulated without regard to the plane). The
/// partner's partner is the edge itself. `tolerance` is a share of the extent, as in SymmetryTolerance::near.
/// O(n log n).
[[nodiscard]] IdVector<EdgeId, EdgeId> mirror_edges(const mesh::Surface& surface, const MirrorPlane& plane,
                                                    double tolerance = SymmetryTolerance{}.near);

/// Some faces of a surface as a surface of their own.
struct PartOf {
  mesh::Surface surface;
  IdVector<VertexId, VertexId> vertex;  ///< in the whole, of each vertex of the part
  IdVector<EdgeId, EdgeId> edge;
  IdVector<FaceId, FaceId> face;
};
/// Where the faces touch each other in a vertex only it is divided. O(n log n) in the number of these faces,
/// O(1) in that of the others.
[[nodiscard]] PartOf part_of(const mesh::Surface& whole, std::span<const FaceId> faces);

}  // namespace ridgecraft::prepare
