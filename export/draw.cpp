// SPDX-License-Identifier: GPL-3.0-or-later
// Puts the drawing of each page together: its pieces, their texts, the furniture.
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/utf8.hpp"
#include "export/export.hpp"
#include "export/page/furniture.hpp"
#include "export/page/neighbours.hpp"
#include "export/page/number_list.hpp"
#include "export/page/page_index.hpp"
#include "export/page/piece_drawing.hpp"
#include "export/page/text_placement.hpp"
#include "export/paint/paint.hpp"
#include "export/sheet/bodies.hpp"
#include "export/sheet/piece_kinds.hpp"

namespace ridgecraft::paper {

namespace {

/// For each piece the words that say which others are equal, which of several separate bodies it belongs to,
/// and, where no number does, beside which piece. O(pieces + joins).
IdVector<PieceId, std::vector<std::string>> piece_notes(const mesh::Surface& surface,
                                                        const unfold::Nets& nets,
                                                        const std::vector<Body>& bodies,
                                                        const std::vector<PieceKind>& kinds) {
  constexpr std::size_t most_names = 4;  // as many as find room on a small piece
  IdVector<PieceId, std::vector<std::string>> notes(nets.pieces.size());
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    for (const unfold::EqualPiece& equal : nets.equal[i]) {
      notes[equal.piece].push_back(kind_words(nets, kinds[i], most_names));
    }
  }
  IdVector<PieceId, bool> joined(nets.pieces.size());
  for (const unfold::Join& join : nets.joins) {
    for (const CornerId side : surface.sides(join.edge)) {
      joined[nets.piece[mesh::face_of(side)]] = true;
    }
  }
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    for (const PieceId piece : bodies[i].pieces) {
      notes[piece].push_back("body " + std::to_string(i + 1) + " of " + std::to_string(bodies.size()));
      if (bodies[i].beside.valid() && !joined[piece]) {
        notes[piece].push_back("at " + nets.pieces[bodies[i].beside].name);
      }
    }
  }
  return notes;
}

/// What becomes of the numbers that found no place on a page's pieces.
void report_numbers(const std::vector<PieceDrawing>& pieces, bool can_list, DrawReport& report) {
  for (const PieceDrawing& piece : pieces) {
    for (const Seam& seam : piece.seams) {
      if (!seam.numbered) {
        (can_list ? report.labels_listed : report.labels_left_out).push_back({piece.name, seam.number});
      }
    }
  }
}

/// Rows of numbers that their page's index has no room for.
struct Unlisted {
  std::size_t page = 0;
  std::vector<std::string> rows;
};

/// Puts lists where pages have room for them by themselves, their own page first, then any. Returns the rows
/// for which none has.
std::vector<std::string> list_beside_pieces(const Paper& paper,
                                            const std::vector<std::vector<PieceDrawing>>& pieces,
                                            const std::vector<Unlisted>& lists,
                                            std::vector<std::vector<Text>>& indices) {
  const auto listed = [&](std::size_t page, const std::vector<std::string>& rows) {
    const auto texts = number_list_beside(paper, pieces[page], indices[page], rows);
    if (texts) {
      indices[page].insert(indices[page].end(), texts->begin(), texts->end());
    }
    return texts.has_value();
  };
  std::vector<std::string> left;
  for (const Unlisted& list : lists) {
    if (!listed(list.page, list.rows)) {
      for (const std::string& row : list.rows) {
        left.push_back(fmt::format("page {}, {}", list.page + 1, row));
      }
    }
  }
  for (std::size_t page = pieces.size(); page-- > 0 && !left.empty();) {
    if (listed(page, left)) {
      left.clear();
    }
  }
  return left;
}

}  // namespace

std::vector<Drawing> draw(const prepare::Prepared& model, const unfold::Nets& nets, const Pages& pages,
                          const Style& style, DrawReport* report, const Context& context) {
  DrawReport sum;
  sum.bodies = find_bodies(model, nets);
  sum.kinds = find_piece_kinds(model, nets);
  const auto notes = piece_notes(model.model.surface, nets, sum.bodies, sum.kinds);
  const auto neighbours = find_neighbours(model.model.surface, nets);
  std::vector<std::vector<Text>> indices;
  std::vector<Unlisted> unlisted;
  const bool can_list = has_room_for_lists(pages.paper);
  const auto contents = piece_contents(model.model.surface, nets);
  std::vector<std::vector<PieceDrawing>> pieces(pages.count);
  std::vector<std::vector<PieceId>> piece_ids(pages.count);
  for (const PieceId piece : ids<PieceId>(nets.pieces.size())) {
    const Placement& placement = pages.placements[piece];
    pieces[placement.page.value()].push_back(
        piece_drawing(model, nets, piece, contents[piece], placement, style));
    pieces[placement.page.value()].back().notes = notes[piece];
    piece_ids[placement.page.value()].push_back(piece);
  }
  std::vector<Drawing> drawings;
  for (std::size_t i = 0; i < pages.count; ++i) {
    context.check();
    place_texts(pieces[i], pages.paper.size, piece_box(pages.paper), style, sum, context);
    report_numbers(pieces[i], can_list, sum);
    PageIndex index = page_index(nets, pages, PageId(i), neighbours, sum.kinds, pieces[i]);
    indices.push_back(std::move(index.texts));
    Unlisted list{i, {}};
    for (const PieceDrawing& piece : pieces[i]) {
      if (std::string row = number_row(piece); !index.lists_numbers && !row.empty()) {
        list.rows.push_back(std::move(row));
      }
    }
    if (!list.rows.empty()) {
      unlisted.push_back(std::move(list));
    }
  }
  const std::vector<std::string> left =
      can_list ? list_beside_pieces(pages.paper, pieces, unlisted, indices) : std::vector<std::string>();
  paint_pieces(model, nets, contents, pages, style, piece_ids, pieces, context);
  for (std::vector<PieceDrawing>& on_page : pieces) {
    drawings.emplace_back();
    for (PieceDrawing& piece : on_page) {
      drawings.back().groups.push_back(std::move(piece.group));
    }
  }
  if (can_list) {
    for (std::vector<Text>& list : number_pages(left, pages.paper)) {
      indices.push_back(std::move(list));
      drawings.emplace_back();
      ++sum.list_pages;
    }
  }
  LineKinds anywhere;
  for (const Drawing& drawing : drawings) {
    anywhere = anywhere | line_kinds(drawing.groups);
  }
  for (std::size_t i = 0; i < drawings.size(); ++i) {
    Drawing& drawing = drawings[i];
    drawing.size = pages.paper.size;
    drawing.title = printable_utf8(model.model.name);
    drawing.page = static_cast<int>(i + 1);
    drawing.page_count = static_cast<int>(drawings.size());
    Group foot = furniture(pages.paper, drawing.title, drawing.page, drawing.page_count,
                           line_kinds(drawing.groups), anywhere);
    foot.texts.insert(foot.texts.end(), indices[i].begin(), indices[i].end());
    drawing.groups.push_back(std::move(foot));
  }
  if (report != nullptr) {
    *report = sum;
  }
  return drawings;
}

}  // namespace ridgecraft::paper
