// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/machine/operations.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

#include "base/geometry.hpp"
#include "export/machine/fold_ends.hpp"
#include "export/machine/kerf.hpp"
#include "export/machine/path_limits.hpp"
#include "export/style/stroke_font.hpp"

namespace ridgecraft::export_ {
namespace {

double length_of_path(const std::vector<Vec2>& points, bool closed) {
  return length_of(points) + (closed ? length(points.front() - points.back()) : 0.0);
}

/// Without crumbs; none where nothing is left.
std::optional<Path> cleaned(Operation operation, const std::vector<Vec2>& points, bool closed) {
  Path path{operation, {}, closed};
  for (const Vec2 p : points) {
    if (path.points.empty() || length(p - path.points.back()) >= nearest_points_mm) {
      path.points.push_back(p);
    }
  }
  // An open line ends where it ended.
  if (!closed && path.points.size() > 1) {
    path.points.back() = points.back();
  }
  while (closed && path.points.size() > 1 &&
         length(path.points.back() - path.points.front()) < nearest_points_mm) {
    path.points.pop_back();
  }
  if (path.points.size() < (closed ? 3 : 2) || length_of_path(path.points, closed) < shortest_path_mm) {
    return std::nullopt;
  }
  return path;
}

std::optional<Operation> operation_of(Layer layer) {
  switch (layer) {
    case Layer::mountain:
      return Operation::mountain;
    case Layer::valley:
      return Operation::valley;
    case Layer::tab_fold:
      return Operation::tab_fold;
    case Layer::label:
    case Layer::piece_name:
    case Layer::shadow:
    case Layer::glue:
      return Operation::engrave;
    case Layer::cut:
      return Operation::cut_inner;  // but for the outline
    case Layer::paint:
    case Layer::tab_fill:
    case Layer::mark:
    case Layer::picture:
      break;
  }
  return std::nullopt;
}

/// The closed cuts of a piece, each in its direction: outlines against the clock, holes with it. The one that
/// goes round all others is the outline.
std::vector<std::vector<Vec2>> loops_of(const Group& group) {
  std::vector<std::vector<Vec2>> loops;
  for (const Line& line : group.lines) {
    if (line.layer == Layer::cut && line.closed) {
      loops.push_back(line.points);
    }
  }
  const auto size = [](const std::vector<Vec2>& loop) { return std::abs(doubled_area(loop)); };
  const auto outline = std::ranges::max_element(loops, {}, size);
  for (std::vector<Vec2>& loop : loops) {
    if ((doubled_area(loop) > 0.0) != (&loop == &*outline)) {
      std::ranges::reverse(loop);
    }
  }
  return loops;
}

bool is_fold(Operation operation) {
  return operation == Operation::mountain || operation == Operation::valley ||
         operation == Operation::tab_fold;
}

/// Where the edge at a tab is folded, its base is a fold like any other.
Operation with_fold(Operation operation, Fold fold) {
  return operation != Operation::tab_fold || fold == Fold::none ? operation
         : fold == Fold::mountain                               ? Operation::mountain
                                                                : Operation::valley;
}

class Plan {
 public:
  Plan(const Drawing& page, const PathRules& rules)
      : rules_(rules), ends_(rules.scores == Scores::ends ? std::optional<FoldEnds>(page) : std::nullopt) {}

  void add_piece(const Group& group) {
    add_loops(group);
    for (const Line& line : group.lines) {
      const auto operation = operation_of(line.layer);
      if (!operation || (line.layer == Layer::cut && line.closed)) {
        continue;
      }
      if (is_fold(with_fold(*operation, line.fold))) {
        add_fold(with_fold(*operation, line.fold), line.points);
      } else if (*operation != Operation::engrave || rules_.engraves) {
        add(*operation, line.points, line.closed);
      }
    }
    for (const Text& text : group.texts) {
      const auto operation = operation_of(text.layer);
      if (!operation || !rules_.engraves) {
        continue;
      }
      for (const std::vector<Vec2>& stroke : text_strokes(text)) {
        add(*operation, stroke, false);
      }
    }
  }

  void add_registration(const Group& group) {
    for (const Line& line : group.lines) {
      add(Operation::registration, line.points, line.closed);
    }
  }

  std::vector<Path> in_order() {
    std::stable_sort(paths_.begin(), paths_.end(),
                     [](const Path& a, const Path& b) { return a.operation < b.operation; });
    return std::move(paths_);
  }

 private:
  void add_loops(const Group& group) {
    const CutPaths cuts = with_kerf(loops_of(group), rules_.kerf_mm);
    for (const std::vector<Vec2>& line : cuts.lines) {
      add(Operation::cut_inner, line, false);
    }
    for (const std::vector<Vec2>& loop : cuts.loops) {
      const bool outer = doubled_area(loop) > 0.0;
      const std::vector<std::vector<Vec2>> open =
          outer ? opened(group, loop) : std::vector<std::vector<Vec2>>();
      for (const std::vector<Vec2>& line : open) {
        add(Operation::cut_outer, line, false);
      }
      if (open.empty()) {
        add(outer ? Operation::cut_outer : Operation::cut_inner, loop, true);
      }
    }
  }

  /// An outline with the bridges that are wanted; nothing where there are none.
  [[nodiscard]] std::vector<std::vector<Vec2>> opened(const Group& group,
                                                      const std::vector<Vec2>& loop) const {
    std::vector<std::vector<Vec2>> tabs;
    for (const Area& area : group.areas) {
      if (area.layer == Layer::tab_fill) {
        tabs.push_back(area.outline);
      }
    }
    // Mitres reach a whole kerf out of a corner.
    return with_bridges(loop, tabs, rules_.kerf_mm + nearest_points_mm, rules_.bridges);
  }

  void add_fold(Operation operation, const std::vector<Vec2>& points) {
    switch (rules_.scores) {
      case Scores::solid:
        add(operation, points, false);
        break;
      case Scores::dashes:
      case Scores::perforate:
        for (const auto& dash : dashes_along(points, pattern_of(rules_.scores, rules_.board))) {
          add(operation, dash, false);
        }
        break;
      case Scores::ends:
        for (const auto& [end, from] :
             {std::pair(points.front(), points[1]), std::pair(points.back(), points[points.size() - 2])}) {
          if (const auto line = ends_->beyond(end, from, rules_.kerf_mm)) {
            add(operation, *line, false);
          }
        }
        break;
      case Scores::none:
        break;
    }
  }

  void add(Operation operation, const std::vector<Vec2>& points, bool closed) {
    std::optional<Path> path = cleaned(operation, points, closed);
    if (!path) {
      return;
    }
    if (closed && (doubled_area(path->points) > 0.0) != (operation == Operation::cut_outer)) {
      std::reverse(path->points.begin(), path->points.end());
    }
    paths_.push_back(std::move(*path));
  }

  PathRules rules_;
  std::optional<FoldEnds> ends_;  ///< for Scores::ends
  std::vector<Path> paths_;
};

/// Furniture isn't a piece: all its lines and texts are marks.
bool is_piece(const Group& group) {
  return std::ranges::any_of(group.lines,
                             [](const Line& line) { return line.layer == Layer::cut && line.closed; });
}

}  // namespace

std::vector<Path> machine_paths(const Drawing& page, const PathRules& rules) {
  Plan plan(page, rules);
  for (const Group& group : page.groups) {
    if (group.id == registration_group) {
      plan.add_registration(group);
    } else if (is_piece(group)) {
      plan.add_piece(group);
    }
  }
  return plan.in_order();
}

}  // namespace ridgecraft::export_
