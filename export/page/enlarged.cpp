// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/page/enlarged.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <utility>

#include "base/boxes.hpp"
#include "export/page/enlarged_part.hpp"

namespace ridgecraft::paper {
namespace {

/// How much larger, the first that has room for all that is wanted.
constexpr std::array<double, 6> scales{2.0, 2.5, 3.0, 4.0, 6.0, 8.0};
/// What is seen around each edge, mm on the piece: enough to find it there.
constexpr double around_mm = 3.0;
/// A picture shows no less, mm on paper; the second where there is no room for that.
constexpr std::array<double, 2> least_mm{30.0, 19.0};
/// Parts of a piece nearer to each other than their surroundings are one picture, as long as it is no larger,
/// mm on the piece.
constexpr double most_part_mm = 45.0;

Box2 both(Box2 a, const Box2& b) {
  a.add(b.low);
  a.add(b.high);
  return a;
}

/// One for each number and name without a place; then those near each other together.
std::vector<Lost> lost_parts(const PieceDrawing& piece, Vec2 most) {
  std::vector<Lost> parts;
  for (std::size_t i = 0; i < piece.seams.size(); ++i) {
    const Seam& seam = piece.seams[i];
    if (seam.told == NumberAt::list) {
      Box2 box = box_of(seam.tab);
      box.add(seam.edge.a);
      box.add(seam.edge.b);
      parts.push_back({{i}, {}, grown(box, around_mm)});
    }
  }
  for (std::size_t i = 0; i < piece.spots.size(); ++i) {
    if (!piece.spots[i].named) {
      parts.push_back({{}, {i}, grown(box_of(piece.spots[i].outlines), around_mm)});
    }
  }
  const Vec2 largest{std::min(most_part_mm, most.x / scales[1]), std::min(most_part_mm, most.y / scales[1])};
  for (bool changed = true; std::exchange(changed, false);) {
    for (std::size_t i = 0; i < parts.size(); ++i) {
      for (std::size_t k = parts.size(); k-- > i + 1;) {
        const Box2 joint = both(parts[i].box, parts[k].box);
        if (meet(parts[i].box, parts[k].box) && joint.size().x <= largest.x && joint.size().y <= largest.y) {
          parts[i].box = joint;
          parts[i].seams.insert(parts[i].seams.end(), parts[k].seams.begin(), parts[k].seams.end());
          parts[i].spots.insert(parts[i].spots.end(), parts[k].spots.begin(), parts[k].spots.end());
          parts.erase(parts.begin() + static_cast<std::ptrdiff_t>(k));
          changed = true;
        }
      }
    }
  }
  return parts;
}

/// The picture at the first scale that has room for all that is lost, else at the one that has for most.
std::optional<EnlargedPart> best_picture(const PieceDrawing& piece, const Lost& lost, const Style& style,
                                         double least, Vec2 room) {
  const std::size_t wanted = lost.seams.size() + lost.spots.size();
  std::optional<EnlargedPart> best;
  std::size_t most_placed = 0;
  for (const double scale : scales) {
    const Vec2 needed = scale * lost.box.size();
    if (best && (needed.x > room.x || needed.y > room.y)) {
      break;
    }
    EnlargedPart picture(piece, lost, scale, least, room);
    const std::size_t placed = picture.place(style);
    if (placed > most_placed) {
      best.emplace(std::move(picture));
      most_placed = placed;
    }
    if (placed == wanted) {
      break;
    }
  }
  return best;
}

}  // namespace

std::vector<Enlarged> enlarged_parts(PieceDrawing& piece, const Style& style, Vec2 most,
                                     const Context& context) {
  std::vector<Enlarged> pictures;
  const Vec2 room{most.x, most.y - most_words_mm};
  if (room.x < least_mm.back() || room.y < least_mm.back()) {
    return pictures;
  }
  for (const Lost& lost : lost_parts(piece, room)) {
    if (context.out_of_grace()) {
      break;
    }
    std::optional<EnlargedPart> best = best_picture(piece, lost, style, least_mm.front(), room);
    if (!best) {
      continue;
    }
    std::optional<EnlargedPart> smaller = best_picture(piece, lost, style, least_mm.back(), room);
    best->tell(piece);
    const bool tells_as_much = smaller && smaller->tells_as_much_as(*best);
    pictures.push_back(std::move(*best).framed());
    if (tells_as_much) {
      Enlarged other = std::move(*smaller).framed();
      if (other.size.x < pictures.back().size.x || other.size.y < pictures.back().size.y) {
        pictures.back().smaller.push_back(std::move(other));
      }
    }
  }
  return pictures;
}

}  // namespace ridgecraft::paper
