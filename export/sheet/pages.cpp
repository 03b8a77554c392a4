// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/sheet/pages.hpp"

#include <cmath>
#include <numbers>

#include "base/elementary.hpp"

namespace ridgecraft::export_ {

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

Vec2 grain_direction(const Paper& paper) {
  const bool upright = paper.size.y >= paper.size.x;
  return upright == (paper.grain == Grain::long_side) ? Vec2{0.0, 1.0} : Vec2{1.0, 0.0};
}

std::vector<PieceId> pieces_off_grain(const IdVector<PieceId, Vec2>& directions, const Pages& pages) {
  constexpr double rounding_degrees = 0.01;
  const double least =
      elementary::cos((grain_tolerance_degrees + rounding_degrees) * std::numbers::pi / 180.0);
  const Vec2 grain = grain_direction(pages.paper);
  std::vector<PieceId> off;
  for (const PieceId piece : ids<PieceId>(follows_grain(pages.paper, directions) ? directions.size() : 0)) {
    const Vec2 line = pages.placements[piece].turn(directions[piece]);
    if (line != Vec2{} && std::abs(dot(line, grain)) < least) {
      off.push_back(piece);
    }
  }
  return off;
}

}  // namespace ridgecraft::export_
