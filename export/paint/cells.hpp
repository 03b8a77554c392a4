// SPDX-License-Identifier: GPL-3.0-or-later
// The parts of a page that bear a model's colours: a piece's faces, a rim beyond its cut edges, and the
// strips of its tabs that lie beside the faces they are glued behind.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/id.hpp"
#include "base/vector.hpp"
#include "export/page/piece_drawing.hpp"
#include "export/sheet/pages.hpp"
#include "mesh/model/surface.hpp"
#include "unfold/net/nets.hpp"

namespace ridgecraft::export_ {

/// Colours reach so far beyond a cut edge, and so far onto a tab, mm: neither scissors nor glue show white
/// paper then.
inline constexpr double bleed_mm = 2.0;

enum class CellKind : std::uint8_t { face, bleed, tab };

struct Cell {
  CellKind kind = CellKind::face;
  std::vector<Vec2> polygon;  ///< on the page, counterclockwise, convex, mm
  FaceId face;                ///< of the surface, whose colours it bears
  std::array<Vec2, 3> at{};   ///< where that face's corners lie, or would lie, on the page
  Box2 box;                   ///< of the polygon
};

/// Weights of a triangle's corners at a point; their sum is 1, and some are negative outside.
[[nodiscard]] std::array<double, 3> weights_at(const std::array<Vec2, 3>& triangle, Vec2 p);

/// Those of a place of the triangle near the one that they belong to: weights below 0 become 0.
[[nodiscard]] std::array<double, 3> kept_within(std::array<double, 3> weights);

/// A convex or simple polygon's part where dot(p - at, normal) <= 0. O(n).
[[nodiscard]] std::vector<Vec2> clipped(const std::vector<Vec2>& polygon, Vec2 at, Vec2 normal);

/// Of a piece. `page` are all pieces of its page with their outlines, `own` is the place of this one among
/// them: the rim ends half-way to other outlines. O(cut edges of the piece x lines of the page).
[[nodiscard]] std::vector<Cell> cells_of(const PieceOnPage& piece, const std::vector<PieceDrawing>& page,
                                         std::size_t own);

}  // namespace ridgecraft::export_
