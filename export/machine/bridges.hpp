// SPDX-License-Identifier: GPL-3.0-or-later
// Bridges that hold a piece in its sheet until somebody presses it out.
#pragma once

#include <vector>

#include "base/vector.hpp"

namespace ridgecraft::export_ {

/// Where outlines stay uncut, so that pieces don't fall out of the sheet.
struct BridgeRules {
  int count = 0;          ///< of one outline; 0: it is cut all round
  double width_mm = 0.4;  ///< of each
};

/// A closed outline with bridges left uncut, as open lines in its direction; empty where it has no room for
/// any, as then it stays closed. Bridges lie on straight stretches, 3 mm or more from a corner, spread evenly
/// around the outline, and before other places on the areas given (tabs, where no trace of them is seen on
/// the model): on sides whose ends are within `within_mm` of an area's border, as a kerf moves outlines. At
/// most `count`. O(n (areas + count)).
[[nodiscard]] std::vector<std::vector<Vec2>> with_bridges(const std::vector<Vec2>& outline,
                                                          const std::vector<std::vector<Vec2>>& areas,
                                                          double within_mm, const BridgeRules& rules);

}  // namespace ridgecraft::export_
