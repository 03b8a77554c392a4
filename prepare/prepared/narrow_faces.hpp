// SPDX-License-Identifier: GPL-3.0-or-later
// Faces that are too narrow to be cut from paper are counted.
#pragma once

#include <cstddef>

#include "mesh/model/surface.hpp"
#include "prepare/prepared/panels.hpp"

namespace ridgecraft::prepare {

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

}  // namespace ridgecraft::prepare
