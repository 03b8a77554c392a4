// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/page/roll_marks.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/elementary.hpp"
#include "export/style/stroke_font.hpp"

namespace ridgecraft::export_ {
namespace {

constexpr double roll_tick_mm = 2.5;
/// Of a bend's length, where that is short.
constexpr double roll_tick_share = 0.25;
constexpr Pen roll_pen{0.15, {}};
constexpr double words_height = 1.9;
constexpr double words_clearance = 0.5;
/// An arrow beside the words, and the gap between.
constexpr double arrow_mm = 4.0;
constexpr double arrow_gap = 1.0;
constexpr double arrow_head = 1.0;
/// Where along a bend the words stand, of its length.
constexpr std::array<double, 5> places_along{0.5, 0.35, 0.65, 0.2, 0.8};

Line thin_line(Vec2 from, Vec2 to) {
  Line line{Layer::mark, {from, to}, false, Fold::none};
  line.like = Layer::label;
  line.pen = roll_pen;
  return line;
}

/// Both arrows, each from the words away.
std::vector<Line> arrows_beside(const Text& text, Vec2 along) {
  std::vector<Line> lines;
  const double start = 0.5 * text_width(text.text, text.height) + arrow_gap;
  for (const double way : {1.0, -1.0}) {
    const Vec2 out = way * along;
    const Vec2 tip = text.centre + (start + arrow_mm) * out;
    lines.push_back(thin_line(text.centre + start * out, tip));
    for (const double side : {1.0, -1.0}) {
      lines.push_back(thin_line(tip, tip + arrow_head * (-out + 0.6 * side * perpendicular(out))));
    }
  }
  return lines;
}

}  // namespace

void add_roll_marks(const PieceOnPage& at, std::span<const RolledPart> parts, PieceDrawing& piece) {
  const auto ends = [&](EdgeId bend) {
    const CornerId side = at.surface().sides(bend)[0];
    return Segment2{at.corner(side), at.corner(mesh::next(side))};
  };
  for (const RolledPart& part : parts) {
    const std::size_t last = part.bends.size() - 1;
    for (const std::size_t i : std::set<std::size_t>{0, last / 2, last}) {
      const Segment2 bend = ends(part.bends[i]);
      const double size = length(bend.b - bend.a);
      if (size > 0.0) {
        const Vec2 tick = std::min(roll_tick_mm / size, roll_tick_share) * (bend.b - bend.a);
        piece.group.lines.push_back(thin_line(bend.a, bend.a + tick));
        piece.group.lines.push_back(thin_line(bend.b, bend.b - tick));
      }
    }
    RollMark mark{roll_words(at.model, part.roll), {}};
    for (const double share : places_along) {
      // From the middle outwards.
      for (std::size_t k = 0; k <= last; ++k) {
        const std::size_t i = k % 2 == 0 ? last / 2 + k / 2 : last / 2 - (k + 1) / 2;
        if (i <= last) {
          const Segment2 bend = ends(part.bends[i]);
          mark.sites.push_back({bend.a + share * (bend.b - bend.a), bend.b - bend.a});
        }
      }
    }
    piece.rolls.push_back(std::move(mark));
  }
}

void place_roll_words(PieceDrawing& piece, Obstacles& obstacles) {
  for (const RollMark& mark : piece.rolls) {
    for (const RollMark::Site& site : mark.sites) {
      const Vec2 across = perpendicular(site.bend);
      Text text{Layer::piece_name,
                mark.words,
                site.at,
                words_height,
                upright(elementary::atan2(across.y, across.x)),
                false};
      const Vec2 along{elementary::cos(text.angle), elementary::sin(text.angle)};
      TurnedBox box = box_of(text);
      box.half_width += arrow_gap + arrow_mm;
      const auto on_piece = [&](double u, double v) {
        return lies_on(piece, box.centre + u * box.half_width * box.along +
                                  v * box.half_height * perpendicular(box.along));
      };
      if (!on_piece(1.0, 1.0) || !on_piece(1.0, -1.0) || !on_piece(-1.0, 1.0) || !on_piece(-1.0, -1.0) ||
          !obstacles.is_free(box, spacing_height(text), words_clearance)) {
        continue;
      }
      obstacles.add(text);
      for (Line& arrow : arrows_beside(text, along)) {
        obstacles.add({arrow.points.front(), arrow.points.back()}, Obstacles::Kind::cut);
        piece.group.lines.push_back(std::move(arrow));
      }
      piece.group.texts.push_back(std::move(text));
      break;
    }
  }
}

}  // namespace ridgecraft::export_
