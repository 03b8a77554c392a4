// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/page/page_room.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "export/page/text_table.hpp"

namespace ridgecraft::export_ {
namespace {

constexpr double index_clearance = 2.5;  ///< from lines and texts of the page, mm
constexpr double place_step = 5.0;       ///< between places that are tried, mm

/// Calls try_at(corner) for the lower left corners that a box of this size may have, the lowest ones first,
/// until it returns true.
template <class Try>
void at_places(const Box2& area, Vec2 size, Try try_at) {
  for (double y = area.low.y; y + size.y <= area.high.y; y += place_step) {
    for (double x = area.low.x; x + size.x <= area.high.x; x += place_step) {
      if (try_at(Vec2{x, y})) {
        return;
      }
    }
  }
}

}  // namespace

PageRoom::PageRoom(const Paper& paper, const std::vector<PieceDrawing>& pieces)
    : area_(piece_box(paper)), obstacles_(paper.size), pieces_(pieces) {
  for (const PieceDrawing& piece : pieces) {
    for (const Line& line : piece.group.lines) {
      for (std::size_t i = 1; i < line.points.size(); ++i) {
        obstacles_.add({line.points[i - 1], line.points[i]}, Obstacles::Kind::cut);
      }
      if (line.closed) {
        obstacles_.add({line.points.back(), line.points.front()}, Obstacles::Kind::cut);
      }
    }
    add(piece.group.texts);
  }
}

void PageRoom::add(const std::vector<Text>& texts) {
  for (const Text& text : texts) {
    obstacles_.add(text);
  }
}

std::optional<std::vector<Text>> PageRoom::place(const std::vector<Text>& texts) const {
  Box2 box;
  std::vector<TurnedBox> from_centre;  // what each text covers around its own centre
  for (const Text& text : texts) {
    const Box2 own = box_of(text).bounds();
    box.add(own.low);
    box.add(own.high);
    Text at_origin = text;
    at_origin.centre = {};
    from_centre.push_back(box_of(at_origin));
  }
  std::optional<std::vector<Text>> found;
  at_places(area_, box.size(), [&](Vec2 corner) {
    const Vec2 shift = corner - box.low;
    for (std::size_t i = 0; i < texts.size(); ++i) {
      if (!free(from_centre[i], texts[i].height, texts[i].centre + shift)) {
        return false;
      }
    }
    found = texts;
    for (Text& text : *found) {
      text.centre += shift;
    }
    return true;
  });
  return found;
}

bool PageRoom::free(TurnedBox text, double height, Vec2 centre) const {
  text.centre += centre;
  // The foot lies below the area: it needs no more than the distance to a line.
  return obstacles_.is_free(text, height, std::min(index_clearance, 0.5 * table_row_height),
                            index_clearance) &&
         !on_a_piece(centre);
}

bool PageRoom::on_a_piece(Vec2 p) const {
  return std::ranges::any_of(pieces_, [&](const PieceDrawing& piece) {
    return std::ranges::any_of(piece.faces, [&](const std::array<Vec2, 3>& f) {
      return cross(f[1] - f[0], p - f[0]) >= 0.0 && cross(f[2] - f[1], p - f[1]) >= 0.0 &&
             cross(f[0] - f[2], p - f[2]) >= 0.0;
    });
  });
}

}  // namespace ridgecraft::export_
