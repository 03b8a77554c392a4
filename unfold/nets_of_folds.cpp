// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/nets_of_folds.hpp"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "unfold/net/nets.hpp"
#include "unfold/patch/layout.hpp"

namespace ridgecraft::unfold {
namespace {

/// A piece before it has its place in the order of all.
struct Draft {
  std::vector<std::uint32_t> faces;
  PartId part;  ///< most of its area belongs to
  double area = 0.0;
};

/// Pieces by part, large ones first.
std::vector<Draft> order_pieces(const mesh::Surface& surface, const IdVector<FaceId, PartId>& part,
                                const Layout& layout) {
  std::vector<Draft> drafts;
  for (const auto& faces : layout.faces) {
    Draft& draft = drafts.emplace_back();
    draft.faces = faces;
    std::sort(draft.faces.begin(), draft.faces.end());
    std::map<PartId, double> area;
    for (const std::uint32_t f : draft.faces) {
      area[part[FaceId(f)]] += surface.area(FaceId(f));
      draft.area += surface.area(FaceId(f));
    }
    draft.part = std::max_element(area.begin(), area.end(), [](const auto& a, const auto& b) {
                   return a.second < b.second;
                 })->first;
  }
  std::stable_sort(drafts.begin(), drafts.end(), [](const Draft& a, const Draft& b) {
    return a.part != b.part ? a.part < b.part : a.area > b.area;
  });
  return drafts;
}

IdVector<EdgeId, EdgeUse> uses_of(const mesh::Surface& surface, const Folds& folds) {
  IdVector<EdgeId, EdgeUse> use(surface.edge_count(), EdgeUse::cut);
  for (const EdgeId e : ids<EdgeId>(surface.edge_count())) {
    if (surface.is_border(e)) {
      use[e] = EdgeUse::border;
    } else if (folds[surface.sides(e)[0].value()] != 0) {
      use[e] = EdgeUse::fold;
    }
  }
  return use;
}

/// The parts that these faces belong to, ascending.
std::vector<PartId> parts_of(const IdVector<FaceId, PartId>& part, const std::vector<FaceId>& faces) {
  std::vector<PartId> parts;
  for (const FaceId f : faces) {
    parts.push_back(part[f]);
  }
  std::sort(parts.begin(), parts.end());
  parts.erase(std::unique(parts.begin(), parts.end()), parts.end());
  return parts;
}

}  // namespace

Nets nets_of_folds(const mesh::Surface& surface, const IdVector<FaceId, PartId>& part, const Patch& patch,
                   const Folds& folds) {
  const Layout layout = lay_out(patch, folds);
  const std::vector<Draft> drafts = order_pieces(surface, part, layout);
  Nets nets;
  nets.use = uses_of(surface, folds);
  nets.piece = IdVector<FaceId, PieceId>(surface.face_count());
  nets.flat = IdVector<FaceId, std::array<Vec2, 3>>(surface.face_count());
  for (const Draft& draft : drafts) {
    const PieceId id(nets.pieces.size());
    Piece piece;
    piece.name = piece_name(nets.pieces.size());
    piece.main_part = draft.part;
    for (const std::uint32_t f : draft.faces) {
      piece.faces.emplace_back(f);
      nets.piece[FaceId(f)] = id;
      nets.flat[FaceId(f)] = layout.flat[f];
    }
    piece.parts = parts_of(part, piece.faces);
    nets.pieces.push_back(std::move(piece));
  }
  return nets;
}

}  // namespace ridgecraft::unfold
