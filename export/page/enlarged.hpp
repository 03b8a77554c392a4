// SPDX-License-Identifier: GPL-3.0-or-later
// Parts of pieces drawn once more, larger: there stand the numbers that have no room on the pieces.
#pragma once

#include <vector>

#include "base/context.hpp"
#include "export/page/enlarged_picture.hpp"
#include "export/page/piece_drawing.hpp"
#include "export/sheet/pages.hpp"

namespace ridgecraft::paper {

/// Draws whatever lies around numbers of the piece without a place, and around names of what is glued on it,
/// twice to eight times as large, lying as on the page; as large as it has to be for all of them. Those that
/// have their place there are told by it (NumberAt::enlarged, GlueSpot::named). `most`: no picture with its
/// words is larger. Nothing where nothing lacks a place, and no more past the context's deadline and grace.
/// O(pictures x scales x lines of the piece + numbers without a place squared).
[[nodiscard]] std::vector<Enlarged> enlarged_parts(PieceDrawing& piece, const Style& style, Vec2 most,
                                                   const Context& context);

}  // namespace ridgecraft::paper
