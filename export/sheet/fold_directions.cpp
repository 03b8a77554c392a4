// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/sheet/fold_directions.hpp"

#include <cmath>

#include "base/elementary.hpp"

namespace ridgecraft::paper {

IdVector<PieceId, Vec2> fold_directions(const mesh::Surface& surface, const unfold::Nets& nets) {
  /// Below this share of all, folds run every way.
  constexpr double least_in_common = 0.05;
  // A direction and its opposite are one line: the square of the complex number x + iy is the same for both.
  IdVector<PieceId, Vec2> squares(nets.pieces.size());
  IdVector<PieceId, double> weights(nets.pieces.size(), 0.0);
  for (const EdgeId edge : ids<EdgeId>(surface.edge_count())) {
    if (nets.use[edge] != unfold::EdgeUse::fold) {
      continue;
    }
    const CornerId side = surface.sides(edge)[0];
    const FaceId face = mesh::face_of(side);
    const Vec2 along = nets.flat[face][mesh::next(side).value() % 3] - nets.flat[face][side.value() % 3];
    const double size = length(along);
    if (!(size > 0.0)) {
      continue;
    }
    const double weight = std::abs(surface.fold_angle(edge)) * size;
    const Vec2 unit = along / size;
    squares[nets.piece[face]] += weight * Vec2{unit.x * unit.x - unit.y * unit.y, 2.0 * unit.x * unit.y};
    weights[nets.piece[face]] += weight;
  }
  IdVector<PieceId, Vec2> directions(nets.pieces.size());
  for (const PieceId piece : ids<PieceId>(nets.pieces.size())) {
    if (length(squares[piece]) > least_in_common * weights[piece]) {
      const double angle = 0.5 * elementary::atan2(squares[piece].y, squares[piece].x);
      directions[piece] = {elementary::cos(angle), elementary::sin(angle)};
    }
  }
  return directions;
}

}  // namespace ridgecraft::paper
