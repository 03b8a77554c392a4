// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/net/nets.hpp"

#include "unfold/net/options.hpp"

namespace ridgecraft::unfold {

std::string_view name(PieceReason reason) {
  switch (reason) {
    case PieceReason::part:
      return "part";
    case PieceReason::page:
      return "page";
    case PieceReason::overlap:
    case PieceReason::no_net:
      return "overlap";
    case PieceReason::tabs:
      return "tabs";
    case PieceReason::faces:
    case PieceReason::shape:
      return "faces";
    case PieceReason::time:
      return "time";
    case PieceReason::request:
    case PieceReason::folding:
      return "request";
    case PieceReason::component:
      return "component";
  }
  return "part";
}

std::string_view sentence(PieceReason reason) {
  switch (reason) {
    case PieceReason::part:
      return "a part of the model";
    case PieceReason::page:
      return "its part doesn't fit the paper in one piece";
    case PieceReason::overlap:
      return "no net of its part was found that doesn't overlap itself";
    case PieceReason::no_net:
      return "its part has no net that doesn't overlap itself (proven)";
    case PieceReason::tabs:
      return "its part has no room for tabs in one piece";
    case PieceReason::faces:
      return "its part has more faces than one piece may have";
    case PieceReason::time:
      return "no net without overlap was found in the time given";
    case PieceReason::request:
      return "cut here on request";
    case PieceReason::component:
      return "its part isn't connected";
    case PieceReason::folding:
      return "its part doesn't fold up with all creases together in one piece";
    case PieceReason::shape:
      return "one piece with its neighbour would be hard to cut out or to fold";
  }
  return "";
}

std::string_view sentence(NoTab reason) {
  switch (reason) {
    case NoTab::has_tab:
      return "";
    case NoTab::edge_too_short:
      return "the edge is too short for a tab";
    case NoTab::no_room:
      return "a tab on either side would lie over a face or another tab";
    case NoTab::target_too_small:
      return "a tab would stick out behind the face it is glued to";
    case NoTab::too_little_paper:
      return "a tab would hang on less than 2 mm of paper";
    case NoTab::beyond_sheet:
      return "the piece with the tab would not fit the paper";
    case NoTab::not_wanted:
      return "tabs are switched off";
    case NoTab::time_up:
      return "the time given was up before a place for a tab was found";
  }
  return "";
}

}  // namespace ridgecraft::unfold
