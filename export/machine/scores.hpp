// SPDX-License-Identifier: GPL-3.0-or-later
// What is cut of a fold, so that it bends there.
#pragma once

#include <vector>

#include "base/vector.hpp"

namespace ridgecraft::export_ {

/// What a machine does at a fold.
enum class Scores {
  solid,      ///< the whole line, scored or creased
  dashes,     ///< cut through in dashes of 2 mm, held by 1 mm of paper each; 5 and 2 mm in board
  perforate,  ///< 3 mm cut, 0.8 mm paper
  ends,       ///< nothing on the piece, but lines of 4 mm beside it that show where the fold begins and ends
  none,
};

/// Lengths in mm.
struct ScorePattern {
  double cut = 2.0;
  double bridge = 1.0;
};

/// The pattern of Scores that have one; board is thicker than 1 mm.
[[nodiscard]] ScorePattern pattern_of(Scores scores, bool board);

/// The dashes along a line, each as a line. It begins and ends with a bridge, as a dash that meets an outline
/// or another fold begins a tear: no dash is nearer to an end than 0.8 bridges. The pattern is stretched to
/// fit, dashes by a quarter at most. Where a dash and two bridges have no room, there is one dash in the
/// middle with a bridge on either side, and none on lines shorter than three bridges. O(n).
[[nodiscard]] std::vector<std::vector<Vec2>> dashes_along(const std::vector<Vec2>& line,
                                                          const ScorePattern& pattern);

/// What lies between two distances along a line.
[[nodiscard]] std::vector<Vec2> stretch_of(const std::vector<Vec2>& line, double from, double to);

}  // namespace ridgecraft::export_
