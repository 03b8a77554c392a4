// SPDX-License-Identifier: GPL-3.0-or-later
// Texts of the guide at their places, and names beside a picture, each with a line to what it names.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "export/sheet/drawing.hpp"

namespace ridgecraft::export_ {

enum class Weight { plain, bold };

/// A text whose baseline begins at `at`.
[[nodiscard]] Text words_from(std::string_view words, Vec2 at, double height, Weight weight = Weight::plain);
/// A text whose baseline ends at `at`.
[[nodiscard]] Text words_to(std::string_view words, Vec2 at, double height, Weight weight = Weight::plain);

/// Rows no wider than `width`, mm; a word that is wider by itself has a row of its own.
[[nodiscard]] std::vector<std::string> wrapped(std::string_view words, double width, double height);

/// As many of the letters as have room, with "…" at the end where some haven't.
[[nodiscard]] std::string shortened(std::string_view words, double width, double height);

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

}  // namespace ridgecraft::export_
