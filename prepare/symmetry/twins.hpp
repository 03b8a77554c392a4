// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies that are equal but for a motion, mirrored or not: wheels, oars, chair legs.
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "base/context.hpp"
#include "base/id.hpp"
#include "mesh/model/surface.hpp"
#include "prepare/symmetry/isometry.hpp"

namespace ridgecraft::prepare {

/// Corners of twins lie within this share of the body's extent of each other: as exact as files are that hold
/// many bodies, and far below what shows in paper.
inline constexpr double twin_tolerance = 1e-3;

/// A body and how it is made of the first one of its kind.
struct Twin {
  std::size_t body = 0;    ///< index into what was asked about
  Isometry motion;         ///< the first body, moved, lies on this one
  double deviation = 0.0;  ///< greatest distance of a moved corner from its partner, in the surface's unit
  bool whole = false;      ///< faces and their connections are the same; else some have no partner
  /// What belongs together, of the first body and of this one; in the first one's order. Corner k of a face
  /// belongs to the corner of its partner that has the partner of its vertex.
  std::vector<std::pair<VertexId, VertexId>> vertices;
  std::vector<std::pair<EdgeId, EdgeId>> edges;
  std::vector<std::pair<FaceId, FaceId>> faces;
};

/// Groups of two or more bodies that are equal, each group's first member being itself with no motion; groups
/// and members by ascending body. A body is a set of faces, as of a component, a part or a piece. Motions
/// that keep the triangles go before others, and those that keep the outside's turn before mirrored ones. O(n
/// log n) where bodies of equal size are twins mostly.
[[nodiscard]] std::vector<std::vector<Twin>> find_twins(const mesh::Surface& surface,
                                                        std::span<const std::vector<FaceId>> bodies,
                                                        const Context& context,
                                                        double tolerance = twin_tolerance);

/// Finds for faces of the first body what of a twin lies in their place.
class TwinFaces {
 public:
  /// `body`: the faces of the twin. All must outlive this. O(n log n).
  TwinFaces(const mesh::Surface& surface, const Twin& twin, std::span<const FaceId> body);

  /// The face's partner; where it has none, since flat regions have other triangles there, of the twin's
  /// faces without a partner the one nearest to where the middle of this one would be, of those that face the
  /// same way if any does. Where the twin has very many of these, any face of it. O(log n), O(faces without a
  /// partner).
  [[nodiscard]] FaceId operator()(FaceId face) const;

 private:
  const mesh::Surface& surface_;
  const Twin& twin_;
  std::span<const FaceId> body_;
  std::vector<FaceId> alone_;  ///< faces of the twin without a partner
};

/// The faces of each component.
[[nodiscard]] std::vector<std::vector<FaceId>> components(const mesh::Surface& surface);

}  // namespace ridgecraft::prepare
