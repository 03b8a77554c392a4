// SPDX-License-Identifier: GPL-3.0-or-later
// Parts of pieces drawn once more, larger: there stand the numbers that have no room on the pieces.
#pragma once

#include <string>
#include <vector>

#include "base/context.hpp"
#include "export/page/page_marks.hpp"
#include "export/page/piece_drawing.hpp"
#include "export/sheet/pages.hpp"

namespace ridgecraft::paper {

/// A picture in a frame. Its lower left corner is the origin; all of it is page furniture, which nobody cuts.
struct Enlarged {
  Vec2 size;
  std::string words;  ///< what it is: "part of D, 3 times as large"
  PageMarks marks;
  std::vector<Enlarged> smaller;  ///< the same with less around it, if it may be smaller
};

/// Draws whatever lies around numbers of the piece without a place, and around names of what is glued on it,
/// twice to eight times as large, lying as on the page; as large as it has to be for all of them. Those that
/// have their place there are told by it (NumberAt::enlarged, GlueSpot::named). `most`: no picture with its
/// words is larger. Nothing where nothing lacks a place or past the context's deadline and grace. O(pictures
/// x scales x lines of the piece).
[[nodiscard]] std::vector<Enlarged> enlarged_parts(PieceDrawing& piece, const Style& style, Vec2 most,
                                                   const Context& context);

/// The picture with its words above it; its size is that of both.
[[nodiscard]] Enlarged with_words(Enlarged picture);

}  // namespace ridgecraft::paper
