// SPDX-License-Identifier: GPL-3.0-or-later
// A model's colours on the pages of its nets.
#pragma once

#include <memory>
#include <vector>

#include "base/context.hpp"
#include "export/page/piece_drawing.hpp"
#include "export/paint/drawn_pictures.hpp"
#include "export/sheet/pages.hpp"
#include "prepare/prepared/prepared.hpp"
#include "unfold/net/nets.hpp"

namespace ridgecraft::export_ {

/// Adds colours to the pieces of all pages, `pages[i]` being those of page i with their texts, `ids[i]` which
/// they are: areas where a face has one colour, a picture a piece where it hasn't; a rim beyond cut edges, a
/// strip on each tab. Gives lines and texts a tone that can be seen on them. Nothing where the model has no
/// look, or Style wants lines alone. Pictures are taken from those of an earlier drawing of the same surface,
/// if there are any, where nothing of them changes. Returns those of this one; none where there are none.
/// Independent of the number of threads, and of what was drawn before. Throws Error(interrupted).
std::shared_ptr<const DrawnPictures> paint_pieces(const prepare::Prepared& model, const unfold::Nets& nets,
                                                  const IdVector<PieceId, PieceContents>& contents,
                                                  const Pages& layout, const Style& style,
                                                  const std::vector<std::vector<PieceId>>& ids,
                                                  std::vector<std::vector<PieceDrawing>>& pages,
                                                  const DrawnPictures* before, const Context& context);

}  // namespace ridgecraft::export_
