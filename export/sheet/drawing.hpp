// SPDX-License-Identifier: GPL-3.0-or-later
// A page as a drawing: typed lines, areas and texts in millimetres. It knows nothing of any file format, and
// a format knows nothing but this.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/vector.hpp"

namespace ridgecraft::paper {

/// What a line, an area or a text is for. A format maps each to a layer, a colour, a style.
enum class Layer {
  tab_fill,  ///< area of a glue tab
  cut,       ///< outline of a piece, its tabs included; holes
  mountain,  ///< fold away from the printed side
  valley,    ///< fold towards the printed side
  tab_fold,  ///< base of a tab
  label,     ///< join numbers
  piece_name,
  mark,  ///< page furniture: scale bar, legend, page number, title
};
inline constexpr int layer_count = 8;
/// Plain identifier, also usable as an XML id: "tab-fill", "cut", ...
[[nodiscard]] std::string_view id(Layer layer);
/// For people: "Tabs", "Cut", "Mountain folds", ...
[[nodiscard]] std::string_view title(Layer layer);

/// Which way the paper is folded at a line; decides its pattern.
enum class Fold {
  none,
  mountain,  ///< away from the viewer
  valley,    ///< towards the viewer
};

struct Line {
  Layer layer = Layer::cut;
  std::vector<Vec2> points;  ///< at least two
  bool closed = false;
  Fold fold = Fold::none;  ///< of folds, bases of tabs and their samples in the legend
  /// Of a mark: looks like a line of this layer, as samples in the legend do.
  Layer like = Layer::mark;
};

struct Area {
  Layer layer = Layer::tab_fill;
  std::vector<Vec2> outline;  ///< closed, simple
};

struct Text {
  Layer layer = Layer::label;
  std::string text;         ///< UTF-8
  Vec2 centre;              ///< middle of the text's box
  double height = 2.5;      ///< of capital letters and digits, mm
  double angle = 0.0;       ///< of the baseline, radians, counterclockwise
  bool underlined = false;  ///< a number that is another number upside down
};

/// All that belongs to one piece; formats keep it together.
struct Group {
  std::string id;  ///< plain identifier, unique on the page: "piece-A"; "page" for furniture
  std::vector<Line> lines;
  std::vector<Area> areas;
  std::vector<Text> texts;
};

/// One page, millimetres, origin at the lower left corner of the sheet, y up.
struct Drawing {
  Vec2 size{210.0, 297.0};
  std::string title;  ///< the model's name
  int page = 1;       ///< from 1
  int page_count = 1;
  std::vector<Group> groups;
};

}  // namespace ridgecraft::paper
