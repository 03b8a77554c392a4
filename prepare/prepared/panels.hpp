// SPDX-License-Identifier: GPL-3.0-or-later
// Flat regions: coplanar neighbours become one panel, so that no fold is drawn inside it.
#pragma once

#include <cstddef>
#include <cstdint>
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

// Faces that are too narrow to be cut from paper are counted.

/// Width that scissors or a knife can cut at all, mm.
inline constexpr double narrow_mm = 0.05;
/// Narrower strips of paper can neither be cut out nor folded by hand, mm.
inline constexpr double sliver_mm = 1.0;
/// Below this width, mm, a face is less than the thinnest line that a printer draws: not even the note helps.
inline constexpr double nothing_mm = 0.005;

/// Whether a panel is nowhere as wide as `width`, mm. O(its faces).
[[nodiscard]] bool is_narrow(const mesh::Surface& surface, const Panels& panels, PanelId panel, double width);

/// Whether a panel is narrower than sliver_mm, and yet not so narrow that it is part of the face beside it on
/// paper. O(its faces).
[[nodiscard]] bool is_sliver(const mesh::Surface& surface, const Panels& panels, PanelId panel);

/// Faces whose panel is a sliver.
[[nodiscard]] std::size_t count_slivers(const mesh::Surface& surface, const Panels& panels);

/// Faces whose panel is nowhere as wide as `width`.
[[nodiscard]] std::size_t count_narrow_faces(const mesh::Surface& surface, const Panels& panels,
                                             double width);

// Flat regions that end where something else does: a material, an object.

/// The same panels divided where faces of different labels meet, one label for each face. O(n log n).
[[nodiscard]] Panels divided_by(const Panels& panels, const mesh::Surface& surface,
                                const IdVector<FaceId, std::uint32_t>& label);

}  // namespace ridgecraft::prepare
