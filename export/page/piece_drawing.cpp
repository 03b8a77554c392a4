// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/page/piece_drawing.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "base/geometry.hpp"
#include "export/page/lines.hpp"
#include "unfold/net/chains.hpp"
#include "unfold/net/outline.hpp"

namespace ridgecraft::export_ {
namespace {

/// Below this a fold is flat whatever the style says, radians (the contract's 1e-4 degrees).
constexpr double flat_angle = 1e-4 * 3.14159265358979323846 / 180.0;
/// Ends of the two sides of a fold that are one point but for rounding, mm.
constexpr double same_fold_end_mm = 1e-4;

class PieceDrawer {
 public:
  PieceDrawer(const PieceOnPage& at, const Style& style)
      : at_(at),
        surface_(at.surface()),
        nets_(at.nets),
        piece_(at.piece),
        contents_(at.contents),
        place_(at.placement),
        style_(style) {
    for (const JoinId join : contents_.joins) {
      join_at_.emplace(nets_.joins[join].edge, join);
    }
  }

  PieceDrawing draw() {
    result_.name = nets_.pieces[piece_].name;
    result_.group.id = "piece-" + result_.name;
    add_cuts();
    add_folds();
    add_tabs();
    add_seams();
    add_rims();
    return std::move(result_);
  }

 private:
  [[nodiscard]] Vec2 corner(CornerId c) const { return at_.corner(c); }
  [[nodiscard]] Segment2 side(CornerId c) const { return {corner(c), corner(mesh::next(c))}; }
  [[nodiscard]] Fold fold_of(EdgeId edge) const {
    const double angle = surface_.fold_angle(edge);
    if (std::abs(angle) < std::max(style_.hidden_fold_angle, flat_angle) || at_.model.rolls.bends(edge)) {
      return Fold::none;
    }
    return angle < 0.0 ? Fold::mountain : Fold::valley;
  }
  void add_line(Layer layer, std::vector<Vec2> points, bool closed, Fold fold = Fold::none) {
    result_.group.lines.push_back({layer, std::move(points), closed, fold});
  }

  void add_cuts() {
    unfold::CutLines cuts = unfold::cut_lines(surface_, nets_, piece_);
    for (auto* lines : {&cuts.loops, &cuts.slits}) {
      for (auto& line : *lines) {
        std::ranges::transform(line, line.begin(), place_);
      }
    }
    std::erase_if(cuts.slits, [](const std::vector<Vec2>& slit) { return length_of(slit) <= crumb_mm; });
    for (auto* lines : {&cuts.loops, &cuts.slits}) {
      for (auto& line : *lines) {
        line = without_crumbs(line, lines == &cuts.loops);
      }
    }
    for (auto& slit : cuts.slits) {
      for (std::size_t i = 1; i < slit.size(); ++i) {
        drawn_.add({slit[i - 1], slit[i]});
      }
      add_line(Layer::cut, std::move(slit), false);
    }
    // Holes before the outline, which comes first there: once that is cut, the piece may move.
    std::ranges::reverse(cuts.loops);
    for (auto& outline : cuts.loops) {
      for (std::size_t i = 0; i < outline.size(); ++i) {
        drawn_.add({outline[i], outline[(i + 1) % outline.size()]});
      }
      add_line(Layer::cut, std::move(outline), true);
    }
  }

  void add_folds() {
    std::vector<FoldSegment> folds;
    for (const FaceId face : nets_.pieces[piece_].faces) {
      for (unsigned k = 0; k < 3; ++k) {
        const CornerId c = mesh::corner(face, k);
        const EdgeId edge = surface_.edge(c);
        if (nets_.use[edge] != unfold::EdgeUse::fold || surface_.sides(edge)[0] != c || within_panel(c)) {
          continue;
        }
        if (const Fold fold = fold_of(edge); fold != Fold::none) {
          folds.push_back({fold_line(c), fold});
        }
      }
    }
    for (const FoldSegment& fold : join_straight(folds)) {
      draw_once(fold, fold.fold == Fold::mountain ? Layer::mountain : Layer::valley);
    }
  }

  /// What the two sides of a fold have in common: in nets of board one may be longer.
  [[nodiscard]] Segment2 fold_line(CornerId c) const {
    const Segment2 one = side(c);
    const Segment2 other = side(surface_.twin(c));
    const double size = length(one.b - one.a);
    if (!(size > 0.0)) {
      return one;
    }
    const Vec2 along = (one.b - one.a) / size;
    const auto at = [&](Vec2 p) { return dot(p - one.a, along); };
    const double from = at(other.b);
    const double to = at(other.a);
    return {from > same_fold_end_mm ? one.a + from * along : one.a,
            to < size - same_fold_end_mm && to > from ? one.a + to * along : one.b};
  }

  [[nodiscard]] bool within_panel(CornerId c) const {
    const auto& panel = at_.model.panels.panel;
    return !panel.empty() && panel[mesh::face_of(c)] == panel[surface_.neighbor(c)];
  }

  void draw_once(const FoldSegment& fold, Layer layer) {
    for (const Segment2& part : drawn_.free_parts(fold.line)) {
      if (length(part.b - part.a) <= crumb_mm) {
        continue;
      }
      drawn_.add(part);
      add_line(layer, {part.a, part.b}, false, fold.fold);
    }
  }

  void add_tabs() {
    std::vector<FoldSegment> bases;
    for (const TabId id : contents_.tabs) {
      const unfold::Tab& tab = nets_.tabs[id];
      tab_at_.emplace(tab.side, id);
      std::vector<Vec2> area;
      for (const Vec2 p : tab.polygon) {
        area.push_back(place_(p));
      }
      bases.push_back({{area[0], area[1]}, tab.of_base ? Fold::mountain : fold_of(surface_.edge(tab.side))});
      // What goes into a slit isn't glued, and its neck is seen on the finished model.
      if (!tab.slit) {
        result_.group.areas.push_back({Layer::tab_fill, std::move(area)});
      }
    }
    for (const FoldSegment& base : bases) {
      draw_once(base, Layer::tab_fold);
    }
  }

  void add_seams() {
    for (const std::vector<CornerId>& side : contents_.sides) {
      result_.sides.emplace_back();
      for (const CornerId c : side) {
        seam_at_.emplace(c, result_.seams.size());
        result_.sides.back().push_back(result_.seams.size());
        result_.seams.push_back(seam_of(c));
      }
    }
    for (const FaceId face : nets_.pieces[piece_].faces) {
      result_.faces.push_back(
          {corner(mesh::corner(face, 0)), corner(mesh::corner(face, 1)), corner(mesh::corner(face, 2))});
    }
  }

  [[nodiscard]] Seam seam_of(CornerId c) const {
    const JoinId id = join_at_.at(surface_.edge(c));
    const PieceId other = nets_.piece[mesh::face_of(surface_.twin(c))];
    Seam seam{nets_.joins[id].number, id, other == piece_ ? "" : nets_.pieces[other].name, side(c), {}};
    // No number on a tab that goes into a slit: its neck is seen on the finished model.
    if (const auto tab = tab_at_.find(c); tab != tab_at_.end() && !nets_.tabs[tab->second].slit) {
      for (const Vec2 p : nets_.tabs[tab->second].polygon) {
        seam.tab.push_back(place_(p));
      }
    }
    return seam;
  }

  /// Faces lie on the left of their edges, so an outline is followed against the clock.
  void add_rims() {
    std::set<CornerId> seen;
    for (const auto& [first, seam] : seam_at_) {
      std::vector<std::size_t> rim;
      for (CornerId c = first; seen.insert(c).second; c = unfold::next_boundary(surface_, nets_, c)) {
        if (const auto here = seam_at_.find(c); here != seam_at_.end()) {
          rim.push_back(here->second);
        }
      }
      if (!rim.empty()) {
        std::ranges::reverse(rim);
        result_.rims.push_back(std::move(rim));
      }
    }
  }

  const PieceOnPage& at_;
  const mesh::Surface& surface_;
  const unfold::Nets& nets_;
  PieceId piece_;
  const PieceContents& contents_;
  const Placement& place_;
  const Style& style_;
  DrawnLines drawn_;
  std::map<EdgeId, JoinId> join_at_;         ///< of each edge that is glued
  std::map<CornerId, TabId> tab_at_;         ///< of each edge that has one
  std::map<CornerId, std::size_t> seam_at_;  ///< of each cut edge that is glued: its place among the seams
  PieceDrawing result_;
};

}  // namespace

bool contains(const std::array<Vec2, 3>& triangle, Vec2 p) {
  const auto& [a, b, c] = triangle;
  return cross(b - a, p - a) >= 0.0 && cross(c - b, p - b) >= 0.0 && cross(a - c, p - c) >= 0.0;
}

bool lies_on(const PieceDrawing& piece, Vec2 p) {
  return std::ranges::any_of(piece.faces, [&](const std::array<Vec2, 3>& face) { return contains(face, p); });
}

IdVector<PieceId, PieceContents> piece_contents(const mesh::Surface& surface, const unfold::Nets& nets) {
  IdVector<PieceId, PieceContents> contents(nets.pieces.size());
  for (const TabId tab : ids<TabId>(nets.tabs.size())) {
    contents[nets.piece[mesh::face_of(nets.tabs[tab].side)]].tabs.push_back(tab);
  }
  for (const unfold::Chain& chain : unfold::chains_of(surface, nets)) {
    std::vector<CornerId> beyond;
    for (const CornerId side : chain.sides) {
      beyond.insert(beyond.begin(), surface.twin(side));
    }
    contents[chain.pieces[0]].sides.push_back(chain.sides);
    contents[chain.pieces[1]].sides.push_back(std::move(beyond));
  }
  for (const JoinId join : ids<JoinId>(nets.joins.size())) {
    for (const CornerId side : surface.sides(nets.joins[join].edge)) {
      std::vector<JoinId>& joins = contents[nets.piece[mesh::face_of(side)]].joins;
      if (joins.empty() || joins.back() != join) {
        joins.push_back(join);
      }
    }
  }
  return contents;
}

PieceDrawing piece_drawing(const PieceOnPage& piece, const Style& style) {
  return PieceDrawer(piece, style).draw();
}

}  // namespace ridgecraft::export_
