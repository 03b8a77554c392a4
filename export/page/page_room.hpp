// SPDX-License-Identifier: GPL-3.0-or-later
// Room beside the pieces of a page, for lists.
#pragma once

#include <optional>
#include <vector>

#include "export/page/obstacles.hpp"
#include "export/page/piece_drawing.hpp"
#include "export/sheet/paper.hpp"

namespace ridgecraft::export_ {

/// All that is drawn on the page, and where its pieces are. Keeps a reference to these.
class PageRoom {
 public:
  PageRoom(const Paper& paper, const std::vector<PieceDrawing>& pieces);

  /// The texts at the lowest place that has room, the leftmost of those. They don't count as being there
  /// until add(). O(places tried x texts).
  [[nodiscard]] std::optional<std::vector<Text>> place(const std::vector<Text>& texts) const;

  void add(const std::vector<Text>& texts);

 private:
  /// Whether there is room for a text of this height that covers `text` around its centre.
  [[nodiscard]] bool free(TurnedBox text, double height, Vec2 centre) const;
  [[nodiscard]] bool on_a_piece(Vec2 p) const;

  Box2 area_;
  Obstacles obstacles_;
  const std::vector<PieceDrawing>& pieces_;
};

}  // namespace ridgecraft::export_
