// SPDX-License-Identifier: GPL-3.0-or-later
// Puts the drawing of each page together: its pieces, their texts, the furniture.
#include <vector>

#include "export/export.hpp"
#include "export/furniture.hpp"
#include "export/piece_drawing.hpp"
#include "export/text_placement.hpp"
#include "export/utf8.hpp"

namespace ridgecraft::paper {

std::vector<Drawing> draw(const mesh::Prepared& model, const unfold::Nets& nets, const Pages& pages,
                          const Style& style, DrawReport* report) {
  std::vector<std::vector<PieceDrawing>> pieces(pages.count);
  for (const PieceId piece : ids<PieceId>(nets.pieces.size())) {
    const Placement& placement = pages.placements[piece];
    pieces[placement.page.value()].push_back(piece_drawing(model, nets, piece, placement, style));
  }
  DrawReport sum;
  std::vector<Drawing> drawings;
  for (std::size_t i = 0; i < pages.count; ++i) {
    place_texts(pieces[i], pages.paper.size, piece_box(pages.paper), style, sum);
    Drawing drawing;
    drawing.size = pages.paper.size;
    drawing.title = printable_utf8(model.model.name);
    drawing.page = static_cast<int>(i + 1);
    drawing.page_count = static_cast<int>(pages.count);
    for (PieceDrawing& piece : pieces[i]) {
      drawing.groups.push_back(std::move(piece.group));
    }
    drawing.groups.push_back(furniture(pages.paper, drawing.title, drawing.page, drawing.page_count));
    drawings.push_back(std::move(drawing));
  }
  if (report != nullptr) {
    *report = sum;
  }
  return drawings;
}

}  // namespace ridgecraft::paper
