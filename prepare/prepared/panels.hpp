// SPDX-License-Identifier: GPL-3.0-or-later
// Flat regions: coplanar neighbours become one panel, so that no fold is drawn inside it.
#pragma once

#include <cstddef>
#include <vector>

#include "base/id.hpp"
#include "mesh/model/surface.hpp"

namespace ridgecraft::prepare {

/// When neighbours count as one flat panel.
struct PanelTolerance {
  /// Normals of a panel's faces against its seed face's, radians (0.1 degrees).
  double angle = 0.1 * 3.14159265358979323846 / 180.0;
  /// Distance of all corners from the seed face's plane, as a share of the surface's diagonal.
  double distance = 1e-5;
};

/// A division of the faces into flat, connected regions.
struct Panels {
  IdVector<FaceId, PanelId> panel;               ///< of each face
  IdVector<PanelId, std::vector<FaceId>> faces;  ///< of each panel, ascending

  [[nodiscard]] std::size_t count() const { return faces.size(); }
};

/// Grows panels over edges from the largest faces down; each is held to the plane of its seed face, so a
/// finely divided cylinder doesn't become one panel. Faces without area join a neighbour's panel. O(n log n).
[[nodiscard]] Panels find_panels(const mesh::Surface& surface, const PanelTolerance& tolerance = {});

/// The panels of some faces of a surface, such as those of PartOf: `face` tells which each was. Panels are
/// numbered in the order of their first faces. O(n log n).
[[nodiscard]] Panels panels_of(const Panels& whole, const IdVector<FaceId, FaceId>& face);

}  // namespace ridgecraft::prepare
