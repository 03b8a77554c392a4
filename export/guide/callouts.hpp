// SPDX-License-Identifier: GPL-3.0-or-later
// Names beside a picture, each with a line to what it names.
#pragma once

#include <string>
#include <vector>

#include "export/sheet/drawing.hpp"

namespace ridgecraft::paper {

struct Callout {
  std::string words;
  Vec2 anchor;  ///< on the page
};

/// Where names may stand: two columns, left and right of a picture.
struct CalloutColumns {
  Box2 box;                 ///< outer ends of the columns, mm
  double left_edge = 0.0;   ///< the left column's words end here ...
  double right_edge = 0.0;  ///< ... and those of the right one begin here
  double height = 2.2;      ///< of the words, mm
};

/// Adds as many as have room, the first ones first: each in the nearer column, or in the other one where that
/// is full, as near to the height of its anchor as others leave room; lines of one column don't cross.
/// Returns how many have found room.
std::size_t add_callouts(const std::vector<Callout>& callouts, const CalloutColumns& columns, Group& group);

}  // namespace ridgecraft::paper
