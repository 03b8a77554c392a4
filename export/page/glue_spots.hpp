// SPDX-License-Identifier: GPL-3.0-or-later
// "Glue here": outlines on a piece of what no join connects with it (sheet/contacts.hpp).
#pragma once

#include "export/page/obstacles.hpp"
#include "export/page/piece_drawing.hpp"
#include "export/sheet/contacts.hpp"

namespace ridgecraft::export_ {

/// Adds a contact's outlines to the drawing of its piece, but for stretches where a line is drawn already;
/// `name` is that of the piece that is glued there.
void add_glue_spot(const Contact& contact, const Placement& placement, const std::string& name,
                   PieceDrawing& piece);

/// Puts the names of what is glued on into their outlines, or beside them with a leader. A name without room
/// is marked so in its spot (GlueSpot::named).
void place_spot_names(PieceDrawing& piece, const Box2& area, Obstacles& obstacles);

/// "A: within dashes B, C": what is glued on a piece and has no room for its name there; empty where all
/// have.
[[nodiscard]] std::string spot_row(const PieceDrawing& piece);

}  // namespace ridgecraft::export_
