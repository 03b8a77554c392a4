// SPDX-License-Identifier: GPL-3.0-or-later
// Lines that show where tabs come to lie behind the faces that they are glued to.
#pragma once

#include "export/page/piece_drawing.hpp"
#include "export/sheet/pages.hpp"
#include "mesh/model/surface.hpp"
#include "unfold/net/nets.hpp"

namespace ridgecraft::export_ {

/// Adds to a piece, whose texts have their places, the outlines of the tabs of other edges that are glued
/// behind its faces: but for their bases, and with gaps where texts stand. Joins with a tab on either side
/// have none, since these are glued to each other. O(joins x texts of the piece).
void add_tab_shadows(const mesh::Surface& surface, const unfold::Nets& nets, PieceId piece,
                     const PieceContents& contents, const Placement& placement, PieceDrawing& drawing);

}  // namespace ridgecraft::export_
