// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/machine/operations.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

#include "export/style/stroke_font.hpp"

namespace ridgecraft::paper {
namespace {

constexpr double shortest_path_mm = 0.2;
constexpr double nearest_points_mm = 0.05;

double length_of(const std::vector<Vec2>& points, bool closed) {
  double sum = closed ? length(points.front() - points.back()) : 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    sum += length(points[i] - points[i - 1]);
  }
  return sum;
}

double doubled_area(const std::vector<Vec2>& points) {
  double sum = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    sum += cross(points[i], points[(i + 1) % points.size()]);
  }
  return sum;
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
  if (path.points.size() < (closed ? 3 : 2) || length_of(path.points, closed) < shortest_path_mm) {
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

/// Of a piece's closed cuts the one that goes round all others.
const Line* outline_of(const Group& group) {
  const Line* outline = nullptr;
  double largest = 0.0;
  for (const Line& line : group.lines) {
    if (line.layer == Layer::cut && line.closed) {
      if (const double area = std::abs(doubled_area(line.points)); area > largest) {
        largest = area;
        outline = &line;
      }
    }
  }
  return outline;
}

/// Lengths of what is cut of a fold and of the bridges that hold it.
constexpr double dash_mm = 2.0;
constexpr double bridge_mm = 1.0;

/// What lies between two places along a line.
std::vector<Vec2> stretch(const std::vector<Vec2>& points, double from, double to) {
  std::vector<Vec2> result;
  double passed = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const double side = length(points[i] - points[i - 1]);
    const auto at = [&](double place) {
      return points[i - 1] + ((place - passed) / side) * (points[i] - points[i - 1]);
    };
    if (side > 0.0 && passed < to && passed + side > from) {
      if (result.empty()) {
        result.push_back(at(std::max(from, passed)));
      }
      result.push_back(at(std::min(to, passed + side)));
    }
    passed += side;
  }
  return result;
}

/// The dashes of a fold, each as a line. It begins and ends with a bridge: a dash that met an outline would
/// begin a tear.
std::vector<std::vector<Vec2>> dashes_along(const std::vector<Vec2>& points) {
  const double whole = length_of(points, false);
  const double count = std::max(1.0, std::round((whole - bridge_mm) / (dash_mm + bridge_mm)));
  const double fit = whole / (count * dash_mm + (count + 1.0) * bridge_mm);
  std::vector<std::vector<Vec2>> dashes;
  for (double i = 0.0; i < count; i += 1.0) {
    const double from = fit * (bridge_mm + i * (dash_mm + bridge_mm));
    dashes.push_back(stretch(points, from, from + fit * dash_mm));
  }
  return dashes;
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
  explicit Plan(const PathRules& rules) : rules_(rules) {}

  void add(const Group& group) {
    const Line* const outline = outline_of(group);
    for (const Line& line : group.lines) {
      if (const auto operation = operation_of(line.layer)) {
        add(&line == outline ? Operation::cut_outer : with_fold(*operation, line.fold), line.points,
            line.closed);
      }
    }
    for (const Text& text : group.texts) {
      if (!rules_.engraves) {
        break;
      }
      if (const auto operation = operation_of(text.layer)) {
        for (const std::vector<Vec2>& stroke : text_strokes(text)) {
          add(*operation, stroke, false);
        }
      }
    }
  }

  std::vector<Path> in_order() {
    std::stable_sort(paths_.begin(), paths_.end(),
                     [](const Path& a, const Path& b) { return a.operation < b.operation; });
    return std::move(paths_);
  }

 private:
  void add(Operation operation, const std::vector<Vec2>& points, bool closed) {
    if (rules_.dashes && is_fold(operation)) {
      for (const std::vector<Vec2>& dash : dashes_along(points)) {
        add_whole(operation, dash, false);
      }
    } else {
      add_whole(operation, points, closed);
    }
  }

  void add_whole(Operation operation, const std::vector<Vec2>& points, bool closed) {
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
  std::vector<Path> paths_;
};

/// Furniture isn't a piece: all its lines and texts are marks.
bool is_piece(const Group& group) {
  return outline_of(group) != nullptr;
}

}  // namespace

std::vector<Path> machine_paths(const Drawing& page, const PathRules& rules) {
  Plan plan(rules);
  for (const Group& group : page.groups) {
    if (is_piece(group)) {
      plan.add(group);
    }
  }
  return plan.in_order();
}

}  // namespace ridgecraft::paper
