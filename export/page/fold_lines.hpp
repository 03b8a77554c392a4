// SPDX-License-Identifier: GPL-3.0-or-later
// The folds of a piece as lines: each stretch once, straight chains as one line.
#pragma once

#include <vector>

#include "export/page/segment2.hpp"
#include "export/sheet/drawing.hpp"

namespace ridgecraft::export_ {

struct FoldSegment {
  Segment2 line;
  Fold fold = Fold::none;
};

/// Joins segments of one kind that go straight on at a common end. O(n log n).
[[nodiscard]] std::vector<FoldSegment> join_straight(const std::vector<FoldSegment>& folds);

/// Remembers what has been drawn, so that nothing is drawn upon it.
class DrawnLines {
 public:
  void add(const Segment2& line) { lines_.push_back(line); }
  /// The parts of a line that lie on nothing drawn so far (segment2.hpp: same_line_mm), from its start to its
  /// end.
  [[nodiscard]] std::vector<Segment2> free_parts(const Segment2& line) const;

 private:
  std::vector<Segment2> lines_;
};

}  // namespace ridgecraft::export_
