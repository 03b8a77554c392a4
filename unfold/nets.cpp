// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/nets.hpp"

#include "unfold/unfold.hpp"

namespace ridgecraft::unfold {

std::string_view name(PieceReason reason) {
  switch (reason) {
    case PieceReason::part: return "part";
    case PieceReason::page: return "page";
    case PieceReason::overlap: return "overlap";
    case PieceReason::tabs: return "tabs";
    case PieceReason::faces: return "faces";
    case PieceReason::time: return "time";
    case PieceReason::request: return "request";
    case PieceReason::component: return "component";
  }
  return "part";
}

std::string_view sentence(NoTab reason) {
  switch (reason) {
    case NoTab::has_tab: return "";
    case NoTab::edge_too_short: return "the edge is too short for a tab";
    case NoTab::no_room: return "a tab on either side would lie over a face or another tab";
    case NoTab::target_too_small: return "a tab would stick out behind the face it is glued to";
    case NoTab::not_wanted: return "tabs are switched off";
  }
  return "";
}

}  // namespace ridgecraft::unfold
