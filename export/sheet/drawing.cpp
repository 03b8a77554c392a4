// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/sheet/drawing.hpp"

#include <algorithm>

#include "export/sheet/pages.hpp"

namespace ridgecraft::export_ {

std::string_view id(Layer layer) {
  switch (layer) {
    case Layer::paint:
      return "paint";
    case Layer::tab_fill:
      return "tab-fill";
    case Layer::cut:
      return "cut";
    case Layer::mountain:
      return "mountain";
    case Layer::valley:
      return "valley";
    case Layer::tab_fold:
      return "tab-fold";
    case Layer::label:
      return "label";
    case Layer::piece_name:
      return "piece-name";
    case Layer::mark:
      return "mark";
    case Layer::shadow:
      return "tab-shadow";
    case Layer::glue:
      return "glue";
    case Layer::picture:
      return "picture";
  }
  return "";
}

std::string_view title(Layer layer) {
  switch (layer) {
    case Layer::paint:
      return "Colours";
    case Layer::tab_fill:
      return "Tabs";
    case Layer::cut:
      return "Cut";
    case Layer::mountain:
      return "Mountain folds";
    case Layer::valley:
      return "Valley folds";
    case Layer::tab_fold:
      return "Tab folds";
    case Layer::label:
      return "Numbers";
    case Layer::piece_name:
      return "Piece names";
    case Layer::mark:
      return "Marks";
    case Layer::shadow:
      return "Tab shadows";
    case Layer::glue:
      return "Glue here";
    case Layer::picture:
      return "Pictures";
  }
  return "";
}

bool has_layer(const Group& group, Layer layer) {
  const auto is_of = [layer](const auto& item) { return item.layer == layer; };
  const bool painted = !group.ground.empty() || !group.images.empty() || !group.fills.empty();
  return (layer == Layer::paint && painted) || std::ranges::any_of(group.areas, is_of) ||
         std::ranges::any_of(group.lines, is_of) || std::ranges::any_of(group.texts, is_of);
}

bool has_layer(const Drawing& page, Layer layer) {
  return std::ranges::any_of(page.groups, [&](const Group& group) { return has_layer(group, layer); });
}

}  // namespace ridgecraft::export_
