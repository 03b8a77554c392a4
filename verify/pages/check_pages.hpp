// SPDX-License-Identifier: GPL-3.0-or-later
// What is printed against the nets.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/vector.hpp"
#include "verify/checks/checks.hpp"
#include "verify/file/relations.hpp"
#include "verify/geometry/geometry.hpp"
#include "verify/pages/printed.hpp"

namespace ridgecraft::verify {

/// Promise 10. Each printed page against the page of the nets that it says it is (or, where it doesn't say
/// so, in the order given): size, outlines with their tabs, folds, bases of tabs, patterns, the scale bar.
/// Lines are compared as sets of points, so it doesn't matter how they are divided. Pages that aren't given
/// aren't missed, but for those of a file that has to be whole. O(n log n).
void check_pages(const Case& given, std::span<const PrintedFile> printed, Findings& findings);

// Words: numbers of joins, names of pieces, the length of the bar.

/// Whether it lists numbers that have no room at their edges.
[[nodiscard]] bool has_list_of_numbers(const PrintedFile& file);

/// What is wrong with the words of a page, as half sentences: each number stands at an edge that it joins, or
/// a line leads from it to one; each piece has the numbers of all its seams, unless there are lists of those
/// that have no room; names stand at their pieces. O(n log n).
[[nodiscard]] std::vector<std::string> faults_of_words(const Case& given, Index page,
                                                       const PrintedPage& printed, bool lists_numbers);

// Lines as a set of points: whether another line lies on them, however the two are divided into segments.

struct Segment {
  Vec2 a;
  Vec2 b;

  [[nodiscard]] double length() const { return ridgecraft::length(b - a); }
};

/// Distance of a point from a segment.
[[nodiscard]] double distance(Vec2 p, const Segment& s);

/// What of a segment lies on no line of a set.
struct Bare {
  double length = 0.0;  ///< of all such stretches together, mm
  Vec2 middle;          ///< of the first one
};

/// Built once in O(n log n).
class LineSet {
 public:
  LineSet() : LineSet(std::vector<Segment>()) {}
  explicit LineSet(std::vector<Segment> lines);

  [[nodiscard]] bool empty() const { return lines_.empty(); }

  /// The stretches of the segment that are farther than the tolerance from every line; nothing if there is
  /// none. About O(log n) and the lines nearby.
  [[nodiscard]] std::optional<Bare> bare(const Segment& segment, double tolerance) const;

  /// Distance of a point from the nearest line, or nothing where all are farther away than `reach`.
  [[nodiscard]] std::optional<double> distance_to(Vec2 p, double reach) const;

 private:
  std::vector<Segment> lines_;
  BoxFinder tree_;
};

// Which lines the nets want on their pages.

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
