// SPDX-License-Identifier: GPL-3.0-or-later
// Which lines the nets want on their pages.
#pragma once

#include <array>
#include <vector>

#include "verify/pages/line_set.hpp"
#include "verify/relations/case.hpp"

namespace ridgecraft::verify {

/// What a line is and how it looks, together.
enum class LineKind { cut, mountain, valley, tab_mountain, tab_valley, tab_flat, glue };
constexpr std::size_t line_kinds = 7;

/// A line that has to be there.
struct WantedLine {
  Segment line;  ///< mm from the page's lower left corner
  Index piece = 0;
  LineKind kind = LineKind::cut;
};

struct WantedPage {
  std::vector<WantedLine> wanted;
  /// What may be there, by kind: all that is wanted, and lines that may be drawn or left out, such as a fold
  /// at the very angle from which on folds are drawn.
  std::array<std::vector<Segment>, line_kinds> allowed;
};

/// One entry for each page of the file, whose own faults don't matter here. O(n log n).
[[nodiscard]] std::vector<WantedPage> wanted_lines(const Case& given);

}  // namespace ridgecraft::verify
