// SPDX-License-Identifier: GPL-3.0-or-later
// What nearly convex parts are good for besides paper: hulls for physics engines, cages, watertight shells.
// Read this header first.
//
//   Surface + Segmentation --hulls--> one convex Body per part
//   Bodies --cage--> one closed Body around them        Surface --shell--> one closed Body around it
//   points + cage before + cage after --deform--> points
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "base/context.hpp"
#include "mesh/model/surface.hpp"
#include "segment/segment.hpp"
#include "solid/body.hpp"

namespace ridgecraft::solid {

/// How large a hull may be.
struct HullOptions {
  /// No hull has more vertices (physics engines have limits); at least 8. 0: as many as it takes.
  std::size_t max_vertices = 0;
};

/// One convex body per part, in the parts' order, that encloses every point of the part, also as rounded
/// doubles. Up to max_vertices it is the part's convex hull, else a polytope around that, of planes that
/// touch the hull, each put where the body so far stood out farthest. The same hulls give the same bytes. A
/// part without volume gets a thickness of 1e-4 of the surface's diagonal. O(n log n) for a part of n
/// vertices, plus O(max_vertices * hull size).
[[nodiscard]] std::vector<Body> part_hulls(const mesh::Surface& surface, const segment::Segmentation& parts,
                                           const HullOptions& options, const Context& context);

/// How coarse a cage is.
struct CageOptions {
  /// At most this many faces, where the shape allows it; at least 20.
  std::size_t faces = 500;
};

/// A closed, manifold surface around all bodies: their union, slightly expanded and coarsened, by alpha
/// wrapping (Portaneri, Rouxel-Labbe, Hemmer, Cohen-Steiner, Alliez, "Alpha wrapping with an offset", ACM
/// Transactions on Graphics 41(4), 2022; CGAL). The probe's size is searched for until the number of faces is
/// just below the one asked for.
[[nodiscard]] Body cage(const std::vector<Body>& bodies, const CageOptions& options, const Context& context);

/// How closely a shell follows.
struct ShellOptions {
  /// Openings and gaps narrower than this are closed, as a share of the bounding box's diagonal; in (0, 1].
  double opening = 0.05;
  /// Distance from the surface at which the shell lies, as a share of the diagonal; in (0, 0.1].
  double offset = 0.002;
};

/// A closed, manifold surface around a broken one, by the same method.
[[nodiscard]] Body shell(const mesh::Surface& surface, const ShellOptions& options, const Context& context);

/// Where points go when the cage around them goes from `before` to `after` (same triangles, at least 4): mean
/// value coordinates (Ju, Schaefer, Warren, "Mean value coordinates for closed triangular meshes", SIGGRAPH
/// 2005). They reproduce every affine map. O(points * cage faces).
[[nodiscard]] std::vector<Vec3> deform(std::span<const Vec3> points, const Body& before, const Body& after,
                                       const Context& context);

}  // namespace ridgecraft::solid
