// SPDX-License-Identifier: GPL-3.0-or-later
// Where separate bodies touch: what no join connects is glued onto a face of another one.
#pragma once

#include <vector>

#include "base/id.hpp"
#include "base/vector.hpp"
#include "mesh/model/surface.hpp"
#include "unfold/net/nets.hpp"

namespace ridgecraft::export_ {

/// Faces of two bodies touch where they are no farther apart than paper is thick, mm.
inline constexpr double contact_mm = mesh::touching_mm;

/// Where the face of one body is glued onto that of another.
struct Contact {
  PieceId piece;  ///< of the larger body: on its face the other one is glued
  PieceId other;  ///< of the smaller body: the piece whose face, or whose border, lies there
  /// Closed outlines of the common area in the plane of `piece`, mm: counterclockwise around it, clockwise
  /// around its holes.
  std::vector<std::vector<Vec2>> outlines;
};

/// All pairs of pieces of different components that have more than a few mm^2 of parallel faces in common, in
/// the order of the pieces; an opening counts as a face of the body that is glued on if its border is flat,
/// so a cap without a back is glued where it stands. Bodies that run through each other's faces don't touch
/// by this. O(n log n) in faces and pairs of faces near each other.
[[nodiscard]] std::vector<Contact> find_contacts(const mesh::Surface& surface, const unfold::Nets& nets);

}  // namespace ridgecraft::export_
