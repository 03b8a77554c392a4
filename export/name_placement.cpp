// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/name_placement.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace ridgecraft::paper {
namespace {

constexpr std::array<double, 7> heights{5.0, 4.2, 3.5, 2.9, 2.4, 2.0, 1.6};
/// A name inside smaller than this is worse than one beside the piece, if there is room, mm.
constexpr double readable_height = 2.4;
constexpr double clearance = 0.5;  ///< mm
/// How much more room than needed is looked for around a name, mm.
constexpr std::array<double, 13> rooms{0.0, 0.4, 0.8, 1.4, 2.2, 3.2, 4.5, 6.5, 9.0, 13.0, 18.0, 26.0, 38.0};

/// Points of a grid that lie in faces of the piece. Its step follows the piece's size.
std::vector<Vec2> grid_points(const PieceDrawing& piece) {
  Box2 bounds;
  for (const auto& face : piece.faces) {
    for (const Vec2 p : face) {
      bounds.add(p);
    }
  }
  constexpr double points_wanted = 1600.0;
  const double step = std::clamp(std::sqrt(bounds.size().x * bounds.size().y / points_wanted), 0.5, 4.0);
  const auto columns = static_cast<std::size_t>(bounds.size().x / step) + 1;
  const auto rows = static_cast<std::size_t>(bounds.size().y / step) + 1;
  std::vector<bool> covered(columns * rows, false);
  const auto at = [&](std::size_t column, std::size_t row) {
    return bounds.low +
           Vec2{(static_cast<double>(column) + 0.5) * step, (static_cast<double>(row) + 0.5) * step};
  };
  for (const auto& face : piece.faces) {
    Box2 box;
    for (const Vec2 p : face) {
      box.add(p);
    }
    const auto first = [&](double low, double origin) {
      return static_cast<std::size_t>(std::max(0.0, (low - origin) / step - 0.5));
    };
    for (std::size_t row = first(box.low.y, bounds.low.y); row < rows && at(0, row).y <= box.high.y; ++row) {
      for (std::size_t column = first(box.low.x, bounds.low.x);
           column < columns && at(column, 0).x <= box.high.x; ++column) {
        const Vec2 p = at(column, row);
        if (cross(face[1] - face[0], p - face[0]) >= 0.0 && cross(face[2] - face[1], p - face[1]) >= 0.0 &&
            cross(face[0] - face[2], p - face[2]) >= 0.0) {
          covered[row * columns + column] = true;
        }
      }
    }
  }
  std::vector<Vec2> points;
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t column = 0; column < columns; ++column) {
      if (covered[row * columns + column]) {
        points.push_back(at(column, row));
      }
    }
  }
  return points;
}

bool within(const TurnedBox& box, const Box2& area) {
  const Box2 bounds = box.bounds();
  return bounds.low.x >= area.low.x && bounds.low.y >= area.low.y && bounds.high.x <= area.high.x &&
         bounds.high.y <= area.high.y;
}

bool place_inside(PieceDrawing& piece, Obstacles& obstacles, double smallest) {
  const std::vector<Vec2> points = grid_points(piece);
  for (const double height : heights) {
    if (height < smallest) {
      break;
    }
    for (const double angle : {0.0, 0.5 * std::numbers::pi}) {
      Text best{Layer::piece_name, piece.name, {}, height, angle, false};
      std::size_t best_room = 0;  // index into rooms, plus one
      for (const Vec2 p : points) {
        Text text = best;
        text.centre = p;
        const TurnedBox box = box_of(text).grown(clearance);
        while (best_room < rooms.size() && obstacles.is_free(box.grown(rooms[best_room]))) {
          ++best_room;
          best.centre = p;
        }
      }
      if (best_room > 0) {
        obstacles.add(box_of(best));
        piece.group.texts.push_back(best);
        return true;
      }
    }
  }
  return false;
}

bool place_beside(PieceDrawing& piece, Obstacles& obstacles, const Box2& area, const Segment2& edge) {
  const Vec2 middle = 0.5 * (edge.a + edge.b);
  const double size = length(edge.b - edge.a);
  if (!(size > 0.0)) {
    return false;
  }
  const Vec2 along = (edge.b - edge.a) / size;
  const Vec2 out = -perpendicular(along);
  for (double reach = 3.0; reach < 16.0; reach += 1.0) {
    for (const double turn : {0.0, 0.5, -0.5, 1.0, -1.0}) {
      const Text text{Layer::piece_name,
                      piece.name,
                      middle + reach * (std::cos(turn) * out + std::sin(turn) * along),
                      3.0,
                      0.0,
                      false};
      const TurnedBox box = box_of(text).grown(clearance);
      const Vec2 d = middle - box.centre;
      const Vec2 tip = box.centre + Vec2{std::clamp(d.x, -box.half_width, box.half_width),
                                         std::clamp(d.y, -box.half_height, box.half_height)};
      const Segment2 leader{middle + 0.03 * out, tip};
      if (within(box, area) && obstacles.is_free(box) && obstacles.is_free(leader, true)) {
        obstacles.add(box_of(text));
        obstacles.add(leader, Obstacles::Kind::cut);
        piece.group.texts.push_back(text);
        piece.group.lines.push_back({Layer::label, {middle, tip}, false, Fold::none});
        return true;
      }
    }
  }
  return false;
}

}  // namespace

bool place_name(PieceDrawing& piece, Obstacles& obstacles, const Box2& area) {
  if (place_inside(piece, obstacles, readable_height)) {
    return true;
  }
  for (const Seam& seam : piece.seams) {
    if (seam.tab.empty() && place_beside(piece, obstacles, area, seam.edge)) {
      return true;
    }
  }
  return place_inside(piece, obstacles, 0.0);
}

}  // namespace ridgecraft::paper
