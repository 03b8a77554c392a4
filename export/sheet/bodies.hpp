// SPDX-License-Identifier: GPL-3.0-or-later
// Separate bodies of a model, and where their pieces lie on each other and are glued without a join.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "base/id.hpp"
#include "base/vector.hpp"
#include "mesh/model/surface.hpp"
#include "prepare/prepared/prepared.hpp"
#include "unfold/net/nets.hpp"

namespace ridgecraft::export_ {

/// Where the face of one body is glued onto that of another.
struct GlueOutline {
  PieceId piece;  ///< of the larger body: on its face the other one is glued
  PieceId other;  ///< of the smaller body: the piece whose face, or whose border, lies there
  /// Closed outlines of the common area in the plane of `piece`, mm: counterclockwise around it, clockwise
  /// around its holes.
  std::vector<std::vector<Vec2>> outlines;
};

/// Bodies that nothing else holds are glued over gaps up to this, mm.
inline constexpr double near_enough_mm = 1.2;

/// All pairs of pieces of different components that have more than a few mm^2 of parallel faces in common, in
/// the order of the pieces, and those that nearly have where nothing else holds a body; an opening counts as
/// a face of the body that is glued on if its border is flat, so a cap without a back is glued where it
/// stands. Bodies that run through each other's faces don't touch by this. Pairs of `except` (GlueOutline's
/// piece and other) are left out. O(n log n) in faces and pairs of faces near each other.
[[nodiscard]] std::vector<GlueOutline> find_glue_outlines(
    const mesh::Surface& surface, const unfold::Nets& nets,
    std::span<const std::array<PieceId, 2>> except = {});

/// A component of the surface, by its pieces.
struct Body {
  std::vector<PieceId> pieces;  ///< ascending
  PieceId beside;               ///< the nearest piece of another body; none where there are too many bodies
  double distance_mm = 0.0;     ///< from it
  /// Its pieces that are glued onto those of other bodies within an outline, with these; ascending.
  std::vector<std::array<PieceId, 2>> glued_onto;
};

/// The components of the surface in the order of their first pieces; empty where there is only one. Distances
/// are those of vertices from faces, both ways, of as many vertices as a fixed amount of work allows.
[[nodiscard]] std::vector<Body> find_bodies(const prepare::Prepared& model, const unfold::Nets& nets,
                                            std::span<const GlueOutline> glue_outlines);

/// How many there are when those that are glued onto each other count as one.
[[nodiscard]] std::size_t bodies_apart(std::span<const Body> bodies);

}  // namespace ridgecraft::export_
