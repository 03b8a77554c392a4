// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/sheet/drawing.hpp"

#include "export/sheet/pages.hpp"

namespace ridgecraft::paper {

std::string_view id(Layer layer) {
  switch (layer) {
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
  }
  return "";
}

std::string_view title(Layer layer) {
  switch (layer) {
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
  }
  return "";
}

}  // namespace ridgecraft::paper
