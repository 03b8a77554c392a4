// SPDX-License-Identifier: GPL-3.0-or-later
// Puts the drawing of each page together: its pieces, their texts, the furniture.
#include <algorithm>
#include <cstddef>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/printable.hpp"
#include "base/utf8.hpp"
#include "export/export.hpp"
#include "export/page/back_of_page.hpp"
#include "export/page/enlarged.hpp"
#include "export/page/furniture.hpp"
#include "export/page/glue_spots.hpp"
#include "export/page/list_pages.hpp"
#include "export/page/neighbours.hpp"
#include "export/page/number_list.hpp"
#include "export/page/page_index.hpp"
#include "export/page/page_marks.hpp"
#include "export/page/piece_drawing.hpp"
#include "export/page/place_marks.hpp"
#include "export/page/tab_shadows.hpp"
#include "export/page/text_placement.hpp"
#include "export/paint/paint.hpp"
#include "export/sheet/bodies.hpp"
#include "export/sheet/piece_kinds.hpp"

namespace ridgecraft::paper {

namespace {

/// For each piece the words that say which object of the model it is of, which others are equal, which of
/// several separate bodies it belongs to, and, where no number does, beside which piece. O(pieces + joins).
IdVector<PieceId, std::vector<std::string>> piece_notes(const mesh::Surface& surface,
                                                        const unfold::Nets& nets,
                                                        const std::vector<Body>& bodies,
                                                        const std::vector<PieceKind>& kinds,
                                                        const IdVector<PieceId, std::string>& objects) {
  constexpr std::size_t most_names = 4;  // as many as find room on a small piece
  IdVector<PieceId, std::vector<std::string>> notes(nets.pieces.size());
  for (const PieceId piece : ids<PieceId>(nets.pieces.size())) {
    if (!objects[piece].empty()) {
      notes[piece].push_back(shortened(objects[piece]));
    }
  }
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
      if (seam.told == NumberAt::enlarged || seam.told == NumberAt::list) {
        (can_list ? report.labels_listed : report.labels_left_out).push_back({piece.name, seam.number});
      }
    }
  }
}

/// Tells a picture, and smaller ones instead of it, which piece of which page it shows, and its letter: that
/// with the number `letters`, which grows where it is used.
void set_place(Enlarged& picture, std::size_t page, std::size_t piece, std::size_t& letters) {
  const auto set = [&](Enlarged& one) {
    one.shown.page = page;
    one.shown.piece = piece;
    one.shown.letter = one.whole ? "" : picture_letter(letters);
  };
  set(picture);
  std::ranges::for_each(picture.smaller, set);
  const bool lettered =
      !picture.whole || std::ranges::any_of(picture.smaller, [](const Enlarged& one) { return !one.whole; });
  letters += lettered ? 1U : 0U;
}

/// How much is to be cut and folded.
void report_lines(const Group& group, DrawReport& report) {
  for (const Line& line : group.lines) {
    double size = line.closed ? length(line.points.front() - line.points.back()) : 0.0;
    for (std::size_t i = 1; i < line.points.size(); ++i) {
      size += length(line.points[i] - line.points[i - 1]);
    }
    report.cut_mm += line.layer == Layer::cut ? size : 0.0;
    report.fold_mm += line.layer != Layer::cut && line.fold != Fold::none ? size : 0.0;
  }
}

}  // namespace

std::vector<Drawing> draw(const prepare::Prepared& model, const unfold::Nets& nets, const Pages& pages,
                          const Style& style, DrawReport* report, const Context& context) {
  DrawReport sum;
  sum.contacts = find_contacts(model.model.surface, nets);
  sum.bodies = find_bodies(model, nets, sum.contacts);
  sum.kinds = find_piece_kinds(model, nets);
  sum.objects = find_piece_objects(model, nets);
  const auto notes = piece_notes(model.model.surface, nets, sum.bodies, sum.kinds, sum.objects);
  const auto neighbours = find_neighbours(model.model.surface, nets);
  std::vector<PageMarks> indices;
  std::vector<PicturePlace> shown;
  std::size_t letters = 0;
  Unplaced left;
  const bool can_list = has_room_for_lists(pages.paper);
  const auto contents = piece_contents(model.model.surface, nets);
  std::vector<std::vector<PieceDrawing>> pieces(pages.count);
  std::vector<std::vector<PieceId>> piece_ids(pages.count);
  for (const PieceId piece : ids<PieceId>(nets.pieces.size())) {
    const Placement& placement = pages.placements[piece];
    pieces[placement.page.value()].push_back(
        piece_drawing(model, nets, piece, contents[piece], placement, style));
    pieces[placement.page.value()].back().notes = notes[piece];
    report_lines(pieces[placement.page.value()].back().group, sum);
    for (const Contact& contact : std::ranges::equal_range(sum.contacts, piece, {}, &Contact::piece)) {
      add_glue_spot(contact, placement, nets.pieces[contact.other].name,
                    pieces[placement.page.value()].back());
    }
    piece_ids[placement.page.value()].push_back(piece);
  }
  std::vector<Drawing> drawings;
  for (std::size_t i = 0; i < pages.count; ++i) {
    context.check();
    place_texts(pieces[i], pages.paper.size, piece_box(pages.paper), style, sum, context);
    std::vector<Enlarged> larger;
    for (std::size_t k = 0; can_list && k < pieces[i].size(); ++k) {
      for (Enlarged& picture : enlarged_parts(pieces[i][k], style, piece_area(pages.paper), context)) {
        set_place(picture, i, k, letters);
        larger.push_back(std::move(picture));
      }
    }
    report_numbers(pieces[i], can_list, sum);
    for (std::size_t k = 0; style.tab_shadows && k < pieces[i].size(); ++k) {
      const PieceId piece = piece_ids[i][k];
      add_tab_shadows(model.model.surface, nets, piece, contents[piece], pages.placements[piece],
                      pieces[i][k]);
    }
    const auto index_with = [&](const Unplaced& others) {
      return page_index(nets, pages, PageId(i), neighbours, sum.kinds, pieces[i], larger, others);
    };
    PageIndex index = index_with({});
    // All that pages have no room for stands on the last one, if all of it finds room there.
    if (i + 1 == pages.count && !left.empty()) {
      if (PageIndex joint = index_with(left); joint.left.empty()) {
        index = std::move(joint);
        left = {};
      }
    }
    indices.push_back(std::move(index.marks));
    shown.insert(shown.end(), index.shown.begin(), index.shown.end());
    left.add(std::move(index.left), i + 1, pages.count > 1);
  }
  // Where all pieces lie on one page, anybody sees where an edge goes on: that is worth no page.
  if (pages.count == 1 && left.numbers.empty() && left.pictures.empty()) {
    left = {};
  }
  std::ranges::transform(left.pictures, std::back_inserter(shown), &Enlarged::shown);
  for (std::size_t i = 0; i < pages.count; ++i) {
    std::vector<PicturePlace> here;
    std::ranges::copy_if(shown, std::back_inserter(here),
                         [&](const PicturePlace& place) { return place.page == i; });
    mark_places(pieces[i], here, indices[i], pages.paper.size, piece_box(pages.paper));
  }
  std::vector<std::vector<Group>> backs(pages.count);
  for (std::size_t i = 0; style.numbers == Numbers::back && i < pages.count; ++i) {
    backs[i] = take_to_back(pieces[i], pages.paper.size, style.turned_over);
  }
  sum.pictures = paint_pieces(model, nets, contents, pages, style, piece_ids, pieces,
                              report == nullptr ? nullptr : report->pictures.get(), context);
  for (std::vector<PieceDrawing>& on_page : pieces) {
    drawings.emplace_back();
    for (PieceDrawing& piece : on_page) {
      drawings.back().groups.push_back(std::move(piece.group));
    }
  }
  if (can_list) {
    for (PageMarks& list : list_pages(std::move(left), pages.paper)) {
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
    if (i < pages.names.size()) {
      drawing.title += printable_utf8(": " + pages.names[i]);
    }
    drawing.page = static_cast<int>(i + 1);
    drawing.page_count = static_cast<int>(drawings.size());
    Group foot;
    foot.id = "page";
    if (pages.paper.furniture) {
      foot = furniture(pages.paper, drawing.title, drawing.page, drawing.page_count,
                       line_kinds(drawing.groups), anywhere);
    }
    const auto append = [](auto& all, const auto& more) { all.insert(all.end(), more.begin(), more.end()); };
    append(foot.texts, indices[i].texts);
    append(foot.lines, indices[i].lines);
    append(foot.areas, indices[i].areas);
    drawing.groups.push_back(std::move(foot));
    if (i < backs.size() && !backs[i].empty()) {
      drawing.back = std::move(backs[i]);
      drawing.back.push_back(foot_of_back(pages.paper, drawing.title, drawing.page, drawing.page_count));
    }
  }
  if (report != nullptr) {
    *report = sum;
  }
  return drawings;
}

}  // namespace ridgecraft::paper
