// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/page/back_of_page.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <utility>

#include "export/page/upright.hpp"

namespace ridgecraft::export_ {
namespace {

/// Where the front of a sheet lies when it is seen from its back.
class Turn {
 public:
  Turn(Vec2 sheet, TurnedOver over)
      : sheet_(sheet), sideways_((over == TurnedOver::long_edge) == (sheet.y >= sheet.x)) {}

  [[nodiscard]] Vec2 operator()(Vec2 p) const {
    return sideways_ ? Vec2{sheet_.x - p.x, p.y} : Vec2{p.x, sheet_.y - p.y};
  }
  [[nodiscard]] Text operator()(Text text) const {
    text.centre = (*this)(text.centre);
    text.angle = upright(sideways_ ? std::numbers::pi - text.angle : -text.angle);
    return text;
  }
  [[nodiscard]] Line operator()(Line line) const {
    std::ranges::transform(line.points, line.points.begin(), *this);
    return line;
  }

 private:
  Vec2 sheet_;
  bool sideways_;  ///< turned over an edge that is upright
};

bool is_word_line(const Line& line) {
  return line.layer == Layer::label || line.layer == Layer::shadow ||
         (line.layer == Layer::mark && line.like == Layer::label);
}

bool on_a_tab(const PieceDrawing& piece, Vec2 p) {
  return std::ranges::any_of(piece.seams, [&](const Seam& seam) {
    for (std::size_t i = 0; i < seam.tab.size(); ++i) {
      const Vec2 a = seam.tab[i];
      if (cross(seam.tab[(i + 1) % seam.tab.size()] - a, p - a) < 0.0) {
        return false;
      }
    }
    return !seam.tab.empty();
  });
}

template <class Items, class Taken>
void move_if(Items& from, Items& to, const Turn& turn, Taken taken) {
  const auto rest =
      std::stable_partition(from.begin(), from.end(), [&](const auto& item) { return !taken(item); });
  std::transform(rest, from.end(), std::back_inserter(to), [&](const auto& item) { return turn(item); });
  from.erase(rest, from.end());
}

}  // namespace

std::vector<Group> take_to_back(std::vector<PieceDrawing>& pieces, Vec2 sheet, TurnedOver turned_over) {
  const Turn turn(sheet, turned_over);
  std::vector<Group> backs;
  for (PieceDrawing& piece : pieces) {
    Group back;
    back.id = "back-" + piece.group.id;
    move_if(piece.group.lines, back.lines, turn, is_word_line);
    move_if(piece.group.texts, back.texts, turn,
            [&](const Text& text) { return !on_a_tab(piece, text.centre); });
    if (!back.lines.empty() || !back.texts.empty()) {
      backs.push_back(std::move(back));
    }
  }
  return backs;
}

}  // namespace ridgecraft::export_
