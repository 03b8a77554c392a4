// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/page/lines.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "base/geometry.hpp"

namespace ridgecraft::export_ {

std::vector<Vec2> without_crumbs(const std::vector<Vec2>& points, bool closed) {
  const std::size_t least = closed ? 3 : 2;
  std::vector<Vec2> kept;
  std::vector<Vec2> gone;  // since the last corner that was kept
  std::size_t left = points.size();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool end = !closed && (i == 0 || i + 1 == points.size());
    const Vec2 p = points[i];
    const Vec2 next = points[(i + 1) % points.size()];
    bool drop = !end && !kept.empty() && left > least &&
                std::min(length(p - kept.back()), length(next - p)) < near_corners_mm;
    if (drop) {
      const auto on_line = [&](Vec2 q) { return distance_to_segment(q, kept.back(), next) < same_line_mm; };
      drop = on_line(p) && std::ranges::all_of(gone, on_line);
    }
    if (drop) {
      gone.push_back(p);
      --left;
    } else {
      kept.push_back(p);
      gone.clear();
    }
  }
  return kept;
}

namespace {

/// Ends of folds of one piece at one vertex of the net are equal up to rounding along the fold tree, far
/// below this (mm).
constexpr double same_end_mm = 1e-4;
/// How far a joined line may be from straight where two folds meet: sine of 0.2 degrees, 0.02 mm over 6 mm.
constexpr double straight_sine = 0.0035;

struct End {
  Vec2 at;
  std::size_t fold;
  bool start;
};

class Joiner {
 public:
  explicit Joiner(const std::vector<FoldSegment>& folds) : folds_(folds), next_(2 * folds.size(), none) {
    std::vector<End> ends;
    for (std::size_t i = 0; i < folds.size(); ++i) {
      ends.push_back({folds[i].line.a, i, true});
      ends.push_back({folds[i].line.b, i, false});
    }
    std::ranges::stable_sort(ends, [](const End& a, const End& b) { return a.at.x < b.at.x; });
    for (std::size_t i = 0; i < ends.size(); ++i) {
      for (std::size_t j = i + 1; j < ends.size() && ends[j].at.x <= ends[i].at.x + same_end_mm; ++j) {
        offer(ends[i], ends[j]);
      }
    }
    match();
  }

  std::vector<FoldSegment> result() {
    std::vector<bool> used(folds_.size(), false);
    std::vector<FoldSegment> joined;
    for (std::size_t i = 0; i < folds_.size(); ++i) {
      if (used[i]) {
        continue;
      }
      used[i] = true;
      const Vec2 a = far_end(i, true, used);
      const Vec2 b = far_end(i, false, used);
      joined.push_back({{a, b}, folds_[i].fold});
    }
    return joined;
  }

 private:
  static constexpr std::size_t none = static_cast<std::size_t>(-1);
  struct Pair {
    double sine;
    std::size_t one;  ///< 2 * fold + (0 at its start, 1 at its end)
    std::size_t two;
  };

  [[nodiscard]] Vec2 end_point(std::size_t end) const {
    const Segment2& line = folds_[end / 2].line;
    return end % 2 == 0 ? line.a : line.b;
  }
  /// Unit vector from an end into its fold.
  [[nodiscard]] Vec2 inward(std::size_t end) const {
    const Vec2 d = end_point(end ^ 1U) - end_point(end);
    const double size = length(d);
    return size > 0.0 ? d / size : Vec2{};
  }

  void offer(const End& a, const End& b) {
    if (a.fold == b.fold || folds_[a.fold].fold != folds_[b.fold].fold || length(a.at - b.at) > same_end_mm) {
      return;
    }
    std::size_t one = 2 * a.fold + (a.start ? 0 : 1);
    std::size_t two = 2 * b.fold + (b.start ? 0 : 1);
    if (one > two) {
      std::swap(one, two);
    }
    const double sine = std::abs(cross(inward(one), inward(two)));
    if (sine < straight_sine && dot(inward(one), inward(two)) < 0.0) {
      pairs_.push_back({sine, one, two});
    }
  }

  /// The straightest pairs first; each end goes on at most once.
  void match() {
    std::ranges::sort(pairs_, [](const Pair& a, const Pair& b) {
      return std::tuple(a.sine, a.one, a.two) < std::tuple(b.sine, b.one, b.two);
    });
    for (const Pair& pair : pairs_) {
      if (next_[pair.one] == none && next_[pair.two] == none) {
        next_[pair.one] = pair.two;
        next_[pair.two] = pair.one;
      }
    }
  }

  Vec2 far_end(std::size_t fold, bool start, std::vector<bool>& used) {
    const std::size_t first = 2 * fold + (start ? 0 : 1);
    const Vec2 direction = -inward(first);
    std::size_t end = first;
    while (next_[end] != none && !used[next_[end] / 2]) {
      const std::size_t beyond = next_[end] ^ 1U;
      // Many small bends in one sense make a curve: the line ends where it would leave its first direction.
      if (std::abs(cross(direction, end_point(beyond) - end_point(first))) > same_line_mm) {
        break;
      }
      used[next_[end] / 2] = true;
      end = beyond;
    }
    return end_point(end);
  }

  const std::vector<FoldSegment>& folds_;
  std::vector<std::size_t> next_;
  std::vector<Pair> pairs_;
};

}  // namespace

std::vector<FoldSegment> join_straight(const std::vector<FoldSegment>& folds) {
  return Joiner(folds).result();
}

std::vector<Segment2> DrawnLines::free_parts(const Segment2& line) const {
  const double size = length(line.b - line.a);
  std::vector<Stretch> covered;
  const Vec2 low{std::min(line.a.x, line.b.x) - same_line_mm, std::min(line.a.y, line.b.y) - same_line_mm};
  const Vec2 high{std::max(line.a.x, line.b.x) + same_line_mm, std::max(line.a.y, line.b.y) + same_line_mm};
  for (const Segment2& drawn : lines_) {
    if (std::max(drawn.a.x, drawn.b.x) < low.x || std::min(drawn.a.x, drawn.b.x) > high.x ||
        std::max(drawn.a.y, drawn.b.y) < low.y || std::min(drawn.a.y, drawn.b.y) > high.y) {
      continue;
    }
    if (const auto stretch = common_stretch(line, drawn)) {
      covered.push_back(*stretch);
    }
  }
  if (covered.empty()) {
    return {line};
  }
  std::ranges::sort(covered, {}, [](const Stretch& s) { return s.from; });
  std::vector<Segment2> parts;
  const Vec2 along = (line.b - line.a) / size;
  double at = 0.0;
  covered.push_back({size, size});
  for (const Stretch& stretch : covered) {
    if (stretch.from - at > shortest_common_mm) {
      parts.push_back({line.a + at * along, line.a + stretch.from * along});
    }
    at = std::max(at, stretch.to);
  }
  return parts;
}

}  // namespace ridgecraft::export_
