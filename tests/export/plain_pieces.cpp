// SPDX-License-Identifier: GPL-3.0-or-later
#include "plain_pieces.hpp"

#include <cmath>
#include <numbers>
#include <string>

#include "base/random.hpp"
#include "mesh/model/surface.hpp"

namespace ridgecraft::test {

void PlainPieces::add(const std::vector<std::array<Vec2, 3>>& triangles, std::uint32_t part) {
  unfold::Piece piece{"P" + std::to_string(nets_.pieces.size()), {}, {PartId(part)}};
  const PieceId id(nets_.pieces.size());
  for (const auto& triangle : triangles) {
    piece.faces.push_back(nets_.flat.push_back(triangle));
    nets_.piece.push_back(id);
  }
  nets_.pieces.push_back(std::move(piece));
}

void PlainPieces::add_fan(const std::vector<Vec2>& corners, std::uint32_t part) {
  std::vector<std::array<Vec2, 3>> triangles;
  for (std::size_t k = 2; k < corners.size(); ++k) {
    triangles.push_back({corners[0], corners[k - 1], corners[k]});
  }
  add(triangles, part);
}

void PlainPieces::add_boxes(const std::vector<std::array<double, 4>>& boxes, std::uint32_t part) {
  std::vector<std::array<Vec2, 3>> triangles;
  for (const auto& [x0, y0, x1, y1] : boxes) {
    triangles.push_back({Vec2{x0, y0}, Vec2{x1, y0}, Vec2{x1, y1}});
    triangles.push_back({Vec2{x0, y0}, Vec2{x1, y1}, Vec2{x0, y1}});
  }
  add(triangles, part);
}

void PlainPieces::add_tab() {
  const FaceId face(nets_.flat.size() - 1);
  const auto& t = nets_.flat[face];
  const Vec2 side = t[1] - t[0];
  const Vec2 out = -5.0 / length(side) * perpendicular(side);
  nets_.tabs.push_back(
      {mesh::corner(face, 0), {}, {t[1], t[0], t[0] + 0.2 * side + out, t[1] - 0.2 * side + out}});
}

double area_of(const unfold::Nets& nets) {
  double sum = 0.0;
  for (const auto& t : nets.flat) {
    sum += 0.5 * std::abs(cross(t[1] - t[0], t[2] - t[0]));
  }
  return sum;
}

std::vector<Vec2> blob(Random& random, double size) {
  const std::uint32_t corners = 3 + random.below(9);
  std::vector<Vec2> polygon{{0.0, 0.0}};
  for (std::uint32_t k = 0; k <= corners; ++k) {
    const double angle = 2.0 * std::numbers::pi * (k % corners) / corners;
    const double radius = k == corners ? length(polygon[1]) : size * (0.3 + 0.7 * random.unit());
    polygon.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  }
  return polygon;
}

}  // namespace ridgecraft::test
