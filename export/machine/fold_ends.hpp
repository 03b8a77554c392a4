// SPDX-License-Identifier: GPL-3.0-or-later
// Lines beside a piece that show where its folds begin and end: the piece itself stays clean.
#pragma once

#include <optional>
#include <vector>

#include "export/sheet/drawing.hpp"

namespace ridgecraft::export_ {

class FoldEnds {
 public:
  /// Of the pieces of a page.
  explicit FoldEnds(const Drawing& page);

  /// The line of 4 mm that goes on beyond the end of a fold that comes from `from`, away from the piece;
  /// shorter where something else is cut there or the sheet ends. None where the fold ends inside the piece,
  /// where nothing has room, or where a cut runs along it. It begins where the beam's cut ends. O(sides of
  /// the page).
  [[nodiscard]] std::optional<std::vector<Vec2>> beyond(Vec2 end, Vec2 from, double kerf_mm) const;

 private:
  struct Side {
    Vec2 a;
    Vec2 b;
  };

  /// From `end` to where the sheet ends, mm.
  [[nodiscard]] double room_on_sheet(Vec2 end, Vec2 away) const;
  [[nodiscard]] bool is_beside_cut(Vec2 p, Vec2 end, double kerf_mm) const;

  Vec2 sheet_;
  std::vector<Side> sides_;               ///< of all that is cut
  std::vector<std::vector<Vec2>> loops_;  ///< outlines and holes
};

}  // namespace ridgecraft::export_
