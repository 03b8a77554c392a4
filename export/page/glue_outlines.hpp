// SPDX-License-Identifier: GPL-3.0-or-later
// Where something is glued onto or behind a piece: outlines of what no join connects with it
// (sheet/bodies.hpp), and lines where tabs come to lie behind its faces.
#pragma once

#include <span>

#include "export/page/obstacles.hpp"
#include "export/page/piece_drawing.hpp"
#include "export/sheet/bodies.hpp"
#include "export/sheet/pages.hpp"
#include "mesh/model/surface.hpp"
#include "unfold/net/nets.hpp"

namespace ridgecraft::export_ {

/// Adds to the drawing of a piece the outlines of what is glued onto it, all of them, but for stretches where
/// a line is drawn already, and those within a body that several of its pieces bring.
void add_glue_outlines(std::span<const GlueOutline> all, const PieceOnPage& piece, PieceDrawing& drawing);

/// Adds to a piece, whose texts have their places, the outlines of the tabs of other edges that are glued
/// behind its faces: but for their bases, and with gaps where texts stand. Joins with a tab on either side
/// have none, since these are glued to each other. O(joins x texts of the piece).
void add_tab_shadows(const PieceOnPage& piece, PieceDrawing& drawing);

}  // namespace ridgecraft::export_
