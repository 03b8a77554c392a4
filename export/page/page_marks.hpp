// SPDX-License-Identifier: GPL-3.0-or-later
// What stands on a page beside its pieces and its foot: lists, and parts of pieces drawn once more.
#pragma once

#include <utility>
#include <vector>

#include "export/sheet/drawing.hpp"

namespace ridgecraft::paper {

/// Page furniture (Layer::mark).
struct PageMarks {
  std::vector<Text> texts;
  std::vector<Line> lines;
  std::vector<Area> areas;

  /// Others, moved by `by`.
  void add(PageMarks others, Vec2 by) {
    for (Text& text : others.texts) {
      text.centre += by;
      texts.push_back(std::move(text));
    }
    for (Line& line : others.lines) {
      for (Vec2& p : line.points) {
        p += by;
      }
      lines.push_back(std::move(line));
    }
    for (Area& area : others.areas) {
      for (Vec2& p : area.outline) {
        p += by;
      }
      areas.push_back(std::move(area));
    }
  }
};

}  // namespace ridgecraft::paper
