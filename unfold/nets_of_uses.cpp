// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/nets_of_uses.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "unfold/folding/fold_order.hpp"
#include "unfold/net/broken_wishes.hpp"
#include "unfold/nets_of_folds.hpp"
#include "unfold/patch/patch.hpp"
#include "unfold/pieces/closing.hpp"

namespace ridgecraft::unfold {
namespace {

constexpr std::array<unsigned, 3> corner_numbers{0, 1, 2};

/// Whether a piece has the faces and folds of one that was there before.
bool is_as_before(const mesh::Surface& surface, const Nets& before, const Nets& nets, const Piece& piece) {
  const Piece& old = before.pieces[before.piece[piece.faces.front()]];
  return old.faces == piece.faces && std::all_of(piece.faces.begin(), piece.faces.end(), [&](FaceId f) {
           return std::all_of(corner_numbers.begin(), corner_numbers.end(), [&](unsigned k) {
             const EdgeId e = surface.edge(mesh::corner(f, k));
             return before.use[e] == nets.use[e];
           });
         });
}

}  // namespace

Causes causes_in(const Nets& nets) {
  Causes causes(nets.piece.size());
  for (const Piece& piece : nets.pieces) {
    for (const FaceId f : piece.faces) {
      causes[f.value()] = {piece.reason, piece.faces.front().value()};
    }
  }
  return causes;
}

Nets nets_of_uses(const mesh::Surface& surface, const prepare::Panels& panels,
                  const IdVector<FaceId, PartId>& part, const EdgeWishes& wishes, const Nets& before,
                  const Nets& changed, const Causes& causes, const Context& context) {
  std::vector<FaceId> faces;
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    faces.push_back(f);
  }
  Folds folds(surface.corner_count(), 0);
  for (const CornerId c : ids<CornerId>(surface.corner_count())) {
    folds[c.value()] = changed.use[surface.edge(c)] == EdgeUse::fold ? 1 : 0;
  }
  Nets nets = nets_of_folds(surface, part, make_patch(surface, panels, faces), folds, causes);
  nets.flat = changed.flat;
  nets.broken_wishes = count_broken(wishes, nets);
  count_holes(surface, nets);
  for (const PieceId p : ids<PieceId>(nets.pieces.size())) {
    Piece& piece = nets.pieces[p];
    piece.folding = is_as_before(surface, before, nets, piece)
                        ? before.pieces[before.piece[piece.faces.front()]].folding
                        : find_fold_order(surface, nets, p, context);
  }
  return nets;
}

}  // namespace ridgecraft::unfold
