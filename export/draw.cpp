// SPDX-License-Identifier: GPL-3.0-or-later
// Puts the drawing of each page together: its pieces, their texts, the furniture.
#include <algorithm>
#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/text.hpp"
#include "export/export.hpp"
#include "export/page/furniture.hpp"
#include "export/page/glue_outlines.hpp"
#include "export/page/lists.hpp"
#include "export/page/piece_drawing.hpp"
#include "export/page/roll_marks.hpp"
#include "export/page/seam_marks.hpp"
#include "export/page/texts.hpp"
#include "export/paint/lost_edges.hpp"
#include "export/paint/paint.hpp"
#include "export/sheet/bodies.hpp"
#include "export/sheet/pieces.hpp"
#include "export/sheet/rolled.hpp"

namespace ridgecraft::export_ {

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

/// Draws all pages, phase by phase: pieces, texts, lists, backs, colours, feet.
class PageDrawer {
 public:
  PageDrawer(const PlacedNets& placed, const Style& style, const Context& context)
      : model_(placed.model),
        surface_(model_.model.surface),
        nets_(placed.nets),
        pages_(placed.pages),
        style_(style),
        context_(context),
        can_list_(has_room_for_lists(pages_.paper)),
        contents_(piece_contents(surface_, nets_)),
        rolled_(rolled_parts(model_, nets_)),
        pieces_(pages_.count),
        piece_ids_(pages_.count),
        backs_(pages_.count) {}

  /// `known`: pictures of an earlier drawing, or nothing.
  std::vector<Drawing> draw(const DrawnPictures* known, std::vector<std::array<PieceId, 2>> not_glued) {
    report_.not_glued = std::move(not_glued);
    describe_pieces();
    draw_pieces();
    for (std::size_t page = 0; page < pages_.count; ++page) {
      context_.check();
      place_texts(pieces_[page], pages_.paper, style_, report_, context_);
      report_listed(page);
      draw_tab_shadows(page);
    }
    lists_ = place_lists({surface_, nets_, pages_, report_.kinds, pieces_});
    report_.list_pages = lists_.size() - pages_.count;
    if (style_.numbers == Numbers::back) {
      for (std::size_t page = 0; page < pages_.count; ++page) {
        backs_[page] = take_to_back(pieces_[page], pages_.paper.size, style_.turned_over);
      }
    }
    report_.pictures =
        paint_pieces({model_, nets_, contents_, pages_, style_, piece_ids_}, pieces_, known, context_);
    draw_lost_edges();
    collect_groups();
    drawings_.resize(lists_.size());
    finish_pages();
    return std::move(drawings_);
  }

  DrawReport report() && { return std::move(report_); }

 private:
  void describe_pieces() {
    report_.glue_outlines = find_glue_outlines(surface_, nets_, report_.not_glued);
    report_.bodies = find_bodies(model_, nets_, report_.glue_outlines);
    report_.kinds = find_piece_kinds(model_, nets_);
    report_.objects = find_piece_objects(model_, nets_);
  }

  [[nodiscard]] PieceOnPage on_page(PieceId id) const {
    return {model_, nets_, id, contents_[id], pages_.placements[id]};
  }

  void draw_pieces() {
    const auto notes = piece_notes(surface_, nets_, report_.bodies, report_.kinds, report_.objects);
    for (const PieceId id : ids<PieceId>(nets_.pieces.size())) {
      const Placement& placement = pages_.placements[id];
      PieceDrawing piece = piece_drawing(on_page(id), style_);
      const auto rolled = std::ranges::equal_range(rolled_, id, {}, &RolledPart::piece);
      add_roll_marks(on_page(id),
                     std::span<const RolledPart>(rolled_).subspan(
                         static_cast<std::size_t>(rolled.begin() - rolled_.begin()),
                         static_cast<std::size_t>(rolled.end() - rolled.begin())),
                     piece);
      add_ticks(piece);
      piece.notes = notes[id];
      report_lines(piece.group, report_);
      const auto glued = std::ranges::equal_range(report_.glue_outlines, id, {}, &GlueOutline::piece);
      const auto first = static_cast<std::size_t>(glued.begin() - report_.glue_outlines.begin());
      const auto count = static_cast<std::size_t>(glued.end() - glued.begin());
      add_glue_outlines(std::span(report_.glue_outlines).subspan(first, count), on_page(id), piece);
      pieces_[placement.page.value()].push_back(std::move(piece));
      piece_ids_[placement.page.value()].push_back(id);
    }
  }

  void report_listed(std::size_t page) {
    for (const PieceDrawing& piece : pieces_[page]) {
      for (const std::vector<std::size_t>& side : piece.sides) {
        const auto listed = std::find_if(side.begin(), side.end(), [&](std::size_t seam) {
          return piece.seams[seam].at == NumberAt::list;
        });
        if (listed != side.end()) {
          (can_list_ ? report_.labels_listed : report_.labels_left_out)
              .push_back({piece.name, piece.seams[*listed].number});
        }
      }
    }
  }

  void draw_tab_shadows(std::size_t page) {
    for (std::size_t i = 0; style_.tab_shadows && i < pieces_[page].size(); ++i) {
      add_tab_shadows(on_page(piece_ids_[page][i]), pieces_[page][i]);
    }
  }

  void draw_lost_edges() {
    if (style_.details != Details::lines && style_.details != Details::automatic) {
      return;
    }
    for (std::size_t page = 0; page < pages_.count; ++page) {
      for (std::size_t i = 0; i < pieces_[page].size(); ++i) {
        add_lost_edges(on_page(piece_ids_[page][i]), pieces_[page][i]);
      }
    }
  }

  void collect_groups() {
    for (std::vector<PieceDrawing>& on_page : pieces_) {
      drawings_.emplace_back();
      for (PieceDrawing& piece : on_page) {
        drawings_.back().groups.push_back(std::move(piece.group));
      }
    }
  }

  /// Titles, feet and lists.
  void finish_pages() {
    LineKinds anywhere;
    for (const Drawing& drawing : drawings_) {
      anywhere = anywhere | line_kinds(drawing.groups);
    }
    for (std::size_t i = 0; i < drawings_.size(); ++i) {
      Drawing& drawing = drawings_[i];
      drawing.size = pages_.paper.size;
      drawing.title = printable_utf8(model_.model.name);
      if (i < pages_.names.size()) {
        drawing.title += printable_utf8(": " + pages_.names[i]);
      }
      drawing.page = static_cast<int>(i + 1);
      drawing.page_count = static_cast<int>(drawings_.size());
      Group foot;
      foot.id = "page";
      if (pages_.paper.furniture) {
        foot = furniture(pages_.paper, drawing, line_kinds(drawing.groups), anywhere);
      }
      foot.texts.insert(foot.texts.end(), lists_[i].begin(), lists_[i].end());
      drawing.groups.push_back(std::move(foot));
      if (i < backs_.size() && !backs_[i].empty()) {
        drawing.back = std::move(backs_[i]);
        drawing.back.push_back(foot_of_back(pages_.paper, drawing));
      }
    }
  }

  const prepare::Prepared& model_;
  const mesh::Surface& surface_;
  const unfold::Nets& nets_;
  const Pages& pages_;
  const Style& style_;
  const Context& context_;
  bool can_list_;
  IdVector<PieceId, PieceContents> contents_;
  std::vector<RolledPart> rolled_;                 ///< by piece
  std::vector<std::vector<PieceDrawing>> pieces_;  ///< of each page
  std::vector<std::vector<PieceId>> piece_ids_;    ///< which these are
  std::vector<std::vector<Text>> lists_;           ///< of each page, list pages included
  std::vector<std::vector<Group>> backs_;
  std::vector<Drawing> drawings_;
  DrawReport report_;
};

}  // namespace

std::vector<Drawing> draw(const PlacedNets& placed, const Style& style, DrawReport* report,
                          const Context& context) {
  PageDrawer drawer(placed, style, context);
  DrawReport given = report == nullptr ? DrawReport() : std::move(*report);
  std::vector<Drawing> drawings = drawer.draw(given.pictures.get(), std::move(given.not_glued));
  if (report != nullptr) {
    *report = std::move(drawer).report();
  }
  return drawings;
}

}  // namespace ridgecraft::export_
