// SPDX-License-Identifier: GPL-3.0-or-later
// Nets of bodies that are copies of others.
#include <algorithm>
#include <array>
#include <map>
#include <utility>
#include <vector>

#include "prepare/prepared/twin_bodies.hpp"
#include "unfold/net/joins.hpp"
#include "unfold/one_of_each.hpp"

namespace ridgecraft::unfold {
namespace {

Vec2 mirrored(Vec2 p) {
  return {-p.x, p.y};
}

/// From faces and sides of the kept surface to those of the whole: in the body itself, or in one of its
/// copies.
class WayBack {
 public:
  WayBack(const Asked& whole, const OneOfEach& each) : whole_(whole), each_(each) {
    place_.resize(each.kept.face.size());
    copies_.resize(each.kept.face.size());
    for (const CopiedBody& copy : each.copies) {
      for (std::uint32_t i = 0; i < copy.from.size(); ++i) {
        place_[copy.from[i]] = i;
        copies_[copy.from[i]].push_back(&copy);
      }
    }
  }

  /// Where a face's body occurs: null stands for itself.
  [[nodiscard]] std::vector<const CopiedBody*> occurrences(FaceId f) const {
    std::vector<const CopiedBody*> all{nullptr};
    all.insert(all.end(), copies_[f].begin(), copies_[f].end());
    return all;
  }
  [[nodiscard]] FaceId face(FaceId f, const CopiedBody* in) const {
    return in == nullptr ? each_.kept.face[f] : in->to[place_[f]];
  }
  [[nodiscard]] CornerId side(CornerId c, const CopiedBody* in) const {
    return prepare::twin_side(face(mesh::face_of(c), in), c.value() % 3, in != nullptr && in->mirrored);
  }
  [[nodiscard]] EdgeId edge(EdgeId e, const CopiedBody* in) const {
    return whole_.surface.edge(side(each_.kept.surface.sides(e)[0], in));
  }
  [[nodiscard]] std::array<Vec2, 3> flat(const std::array<Vec2, 3>& corners, const CopiedBody* in) const {
    return in == nullptr || !in->mirrored
               ? corners
               : std::array{mirrored(corners[0]), mirrored(corners[2]), mirrored(corners[1])};
  }

 private:
  const Asked& whole_;
  const OneOfEach& each_;
  IdVector<FaceId, std::uint32_t> place_;  ///< in CopiedBody::from
  IdVector<FaceId, std::vector<const CopiedBody*>> copies_;
};

std::vector<Vec2> polygon_of(const std::vector<Vec2>& polygon, bool mirrors) {
  if (!mirrors) {
    return polygon;
  }
  // The first two corners are the base's, whose direction turns round as well.
  std::vector<Vec2> result;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    result.push_back(mirrored(polygon[(polygon.size() + 1 - i) % polygon.size()]));
  }
  return result;
}

/// The part that most of a piece's area belongs to: pieces come by it.
PartId main_part(const Asked& whole, const std::vector<FaceId>& faces) {
  std::map<PartId, double> area;
  for (const FaceId f : faces) {
    area[whole.part[f]] += whole.surface.area(f);
  }
  return std::max_element(area.begin(), area.end(),
                          [](const auto& a, const auto& b) { return a.second < b.second; })
      ->first;
}

Piece copied_piece(const Asked& whole, const WayBack& way, const Piece& piece, const CopiedBody* in) {
  Piece copy = piece;
  copy.parts.clear();
  for (FaceId& f : copy.faces) {
    f = way.face(f, in);
    copy.parts.push_back(whole.part[f]);
  }
  std::sort(copy.faces.begin(), copy.faces.end());
  std::sort(copy.parts.begin(), copy.parts.end());
  copy.parts.erase(std::unique(copy.parts.begin(), copy.parts.end()), copy.parts.end());
  for (std::vector<CornerId>& step : copy.folding.steps) {
    for (CornerId& side : step) {
      side = way.side(side, in);
    }
  }
  if (copy.folding.in_the_way) {
    for (FaceId& f : *copy.folding.in_the_way) {
      f = way.face(f, in);
    }
  }
  return copy;
}

}  // namespace

Nets with_copies(const Asked& whole, const OneOfEach& each, const Nets& nets) {
  const WayBack way(whole, each);
  Nets all;
  all.notes = nets.notes;
  all.use = IdVector<EdgeId, EdgeUse>(whole.surface.edge_count());
  all.piece = IdVector<FaceId, PieceId>(whole.surface.face_count());
  all.flat = IdVector<FaceId, std::array<Vec2, 3>>(whole.surface.face_count());
  for (const EdgeId e : ids<EdgeId>(nets.use.size())) {
    for (const CopiedBody* in : way.occurrences(mesh::face_of(each.kept.surface.sides(e)[0]))) {
      all.use[way.edge(e, in)] = nets.use[e];
    }
  }
  for (const FaceId f : ids<FaceId>(nets.flat.size())) {
    for (const CopiedBody* in : way.occurrences(f)) {
      all.flat[way.face(f, in)] = way.flat(nets.flat[f], in);
    }
  }
  std::vector<std::pair<PartId, Piece>> drafts;
  for (const Piece& piece : nets.pieces) {
    for (const CopiedBody* in : way.occurrences(piece.faces.front())) {
      Piece copy = copied_piece(whole, way, piece, in);
      const PartId part = main_part(whole, copy.faces);
      drafts.emplace_back(part, std::move(copy));
    }
  }
  std::stable_sort(drafts.begin(), drafts.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  for (auto& [part, piece] : drafts) {
    piece.name = piece_name(all.pieces.size());
    for (const FaceId f : piece.faces) {
      all.piece[f] = PieceId(all.pieces.size());
    }
    all.pieces.push_back(std::move(piece));
  }
  number_joins(whole.surface, all);
  copy_tabs(whole, each, nets, all);
  return all;
}

std::optional<Nets> without_copies(const Asked& whole, const OneOfEach& each, const Nets& nets) {
  const WayBack way(whole, each);
  Nets result;
  result.use = IdVector<EdgeId, EdgeUse>(each.kept.edge.size());
  for (const EdgeId e : ids<EdgeId>(each.kept.edge.size())) {
    result.use[e] = nets.use[each.kept.edge[e]];
    for (const CopiedBody* in : way.occurrences(mesh::face_of(each.kept.surface.sides(e)[0]))) {
      if (nets.use[way.edge(e, in)] != result.use[e]) {
        return std::nullopt;
      }
    }
  }
  std::map<PieceId, PieceId> number;
  for (const FaceId f : ids<FaceId>(each.kept.face.size())) {
    const FaceId own = each.kept.face[f];
    for (const CopiedBody* in : way.occurrences(f)) {
      if (nets.flat[way.face(f, in)] != way.flat(nets.flat[own], in)) {
        return std::nullopt;
      }
    }
    result.flat.push_back(nets.flat[own]);
    number.try_emplace(nets.piece[own], PieceId(0));
  }
  for (auto& [old, fresh] : number) {
    Piece piece = nets.pieces[old];
    piece.faces.clear();
    fresh = result.pieces.push_back(std::move(piece));
  }
  for (const FaceId f : ids<FaceId>(each.kept.face.size())) {
    const PieceId p = number.at(nets.piece[each.kept.face[f]]);
    result.piece.push_back(p);
    result.pieces[p].faces.push_back(f);
  }
  return result;
}

void copy_tabs(const Asked& whole, const OneOfEach& each, const Nets& tabbed, Nets& nets) {
  const WayBack way(whole, each);
  // Of each edge of the whole the join without copies that it is an image of, and where.
  IdVector<EdgeId, std::pair<JoinId, const CopiedBody*>> source(whole.surface.edge_count());
  for (const JoinId j : ids<JoinId>(tabbed.joins.size())) {
    const EdgeId e = tabbed.joins[j].edge;
    for (const CopiedBody* in : way.occurrences(mesh::face_of(each.kept.surface.sides(e)[0]))) {
      source[way.edge(e, in)] = {j, in};
    }
  }
  nets.tabs = {};
  for (const JoinId j : ids<JoinId>(nets.joins.size())) {
    Join& join = nets.joins[j];
    const auto& [original, in] = source[join.edge];
    const Join& from = tabbed.joins[original];
    join.no_tab = from.no_tab;
    join.too_narrow = from.too_narrow;
    if (from.tab.valid()) {
      const Tab& tab = tabbed.tabs[from.tab];
      join.tab = nets.tabs.push_back(
          {way.side(tab.side, in), j, polygon_of(tab.polygon, in != nullptr && in->mirrored)});
    }
  }
}

}  // namespace ridgecraft::unfold
