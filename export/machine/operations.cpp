// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/machine/operations.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "base/geometry.hpp"
#include "export/machine/kerf.hpp"
#include "export/sheet/drawing.hpp"
#include "export/style/stroke_font.hpp"

namespace ridgecraft::export_ {
namespace {

/// How far a dash may be stretched, and a bridge shortened, so that the pattern fits.
constexpr double longest_dash = 1.25;
constexpr double shortest_bridge = 0.8;

constexpr ScorePattern dashes_of_card{2.0, 1.0};
constexpr ScorePattern dashes_of_board{5.0, 2.0};
constexpr ScorePattern perforation{3.0, 0.8};

/// What lies between two distances along a line.
std::vector<Vec2> stretch_of(const std::vector<Vec2>& line, double from, double to) {
  std::vector<Vec2> result;
  double passed = 0.0;
  for (std::size_t i = 1; i < line.size(); ++i) {
    const double side = length(line[i] - line[i - 1]);
    const auto at = [&](double place) {
      return line[i - 1] + ((place - passed) / side) * (line[i] - line[i - 1]);
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

}  // namespace

ScorePattern pattern_of(Scores scores, bool board) {
  return scores == Scores::perforate ? perforation : board ? dashes_of_board : dashes_of_card;
}

std::vector<std::vector<Vec2>> dashes_along(const std::vector<Vec2>& line, const ScorePattern& pattern) {
  const double whole = length_of(line);
  const auto [cut, bridge] = pattern;
  if (whole < 3.0 * bridge) {
    return {};
  }
  if (whole < 2.0 * bridge + cut) {
    return {stretch_of(line, bridge, whole - bridge)};
  }
  const double count = std::max(1.0, std::round((whole - bridge) / (cut + bridge)));
  double dash = cut * whole / (count * cut + (count + 1.0) * bridge);
  dash = std::min(dash, longest_dash * cut);
  double between = (whole - count * dash) / (count + 1.0);
  if (between < shortest_bridge * bridge) {
    between = shortest_bridge * bridge;
    dash = (whole - (count + 1.0) * between) / count;
  }
  std::vector<std::vector<Vec2>> dashes;
  for (double i = 0.0; i < count; i += 1.0) {
    const double from = between + i * (dash + between);
    dashes.push_back(stretch_of(line, from, from + dash));
  }
  return dashes;
}

namespace {

constexpr double from_corners_mm = 3.0;
/// Places on one side, mm from each other.
constexpr double bridge_step_mm = 8.0;

/// Where a bridge can be: its middle, as a distance along the outline.
struct Place {
  double at = 0.0;
  bool favoured = false;
};

/// Whether both ends of a side are within the distance of one side of an area, but for the area's first one:
/// there it hangs on the rest.
bool on_area(Vec2 a, Vec2 b, const std::vector<std::vector<Vec2>>& areas, double within_mm) {
  return std::ranges::any_of(areas, [&](const std::vector<Vec2>& area) {
    for (std::size_t i = 1; i < area.size(); ++i) {
      const Vec2 c = area[i];
      const Vec2 d = area[(i + 1) % area.size()];
      if (distance_to_segment(a, c, d) < within_mm && distance_to_segment(b, c, d) < within_mm) {
        return true;
      }
    }
    return false;
  });
}

std::vector<Place> places_on(const std::vector<Vec2>& outline, const std::vector<std::vector<Vec2>>& areas,
                             double within_mm, double width) {
  std::vector<Place> places;
  double passed = 0.0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2 a = outline[i];
    const Vec2 b = outline[(i + 1) % outline.size()];
    const double side = length(b - a);
    const double room = side - width - 2.0 * from_corners_mm;
    if (room >= 0.0) {
      const double count = std::floor(room / bridge_step_mm) + 1.0;
      const bool favoured = on_area(a, b, areas, within_mm);
      for (double k = 0.0; k < count; k += 1.0) {
        const double fraction = count > 1.0 ? k / (count - 1.0) : 0.5;
        places.push_back({passed + 0.5 * (side - room) + fraction * room, favoured});
      }
    }
    passed += side;
  }
  return places;
}

/// A closed outline with bridges left uncut, as open lines in its direction; empty where it has no room for
/// any, as then it stays closed. Bridges lie on straight stretches, 3 mm or more from a corner, spread evenly
/// around the outline, and before other places on the areas given (tabs, where no trace of them is seen on
/// the model): on sides whose ends are within `within_mm` of an area's border, as a kerf moves outlines. At
/// most `count`. O(n (areas + count)).
std::vector<std::vector<Vec2>> with_bridges(const std::vector<Vec2>& outline,
                                            const std::vector<std::vector<Vec2>>& areas, double within_mm,
                                            const BridgeRules& rules) {
  std::vector<Place> places = places_on(outline, areas, within_mm, rules.width_mm);
  if (rules.count <= 0 || places.empty()) {
    return {};
  }
  std::vector<Vec2> round = outline;
  round.push_back(outline.front());
  const double whole = length_of(round);
  const double spacing = whole / rules.count;
  // Each bridge where it is nearest to its even place; a favoured place may be half of that farther off.
  std::vector<double> bridges;
  for (int i = 0; i < rules.count && !places.empty(); ++i) {
    const double wanted = (i + 0.5) * spacing;
    const auto cost = [&](const Place& place) {
      const double off = std::abs(place.at - wanted);
      return std::min(off, whole - off) + (place.favoured ? 0.0 : 0.5 * spacing);
    };
    const auto best = std::ranges::min_element(places, {}, cost);
    bridges.push_back(best->at);
    places.erase(best);
  }
  std::ranges::sort(bridges);
  // The outline twice, so that the last line goes on over its beginning.
  std::vector<Vec2> twice = round;
  twice.insert(twice.end(), outline.begin() + 1, outline.end());
  twice.push_back(outline.front());
  std::vector<std::vector<Vec2>> lines;
  for (std::size_t i = 0; i < bridges.size(); ++i) {
    const double from = bridges[i] + 0.5 * rules.width_mm;
    const double next = i + 1 < bridges.size() ? bridges[i + 1] : bridges[0] + whole;
    lines.push_back(stretch_of(twice, from, next - 0.5 * rules.width_mm));
  }
  return lines;
}

/// Lines beside a piece that show where its folds begin and end: the piece itself stays clean.
class FoldEnds {
 public:
  /// Of the pieces of a page.
  explicit FoldEnds(const Drawing& page);

  /// The line of 4 mm that goes on beyond the end of a fold that comes from `from`, away from the piece;
  /// shorter where something else is cut there or the sheet ends. None where the fold ends inside the piece,
  /// where nothing has room, or where a cut runs along it. It begins where the beam's cut ends. O(sides of
  /// the page).
  [[nodiscard]] std::optional<std::vector<Vec2>> beyond(Vec2 end, Vec2 from, double kerf_mm) const;

 private:
  struct Side {
    Vec2 a;
    Vec2 b;
  };

  /// From `end` to where the sheet ends, mm.
  [[nodiscard]] double room_on_sheet(Vec2 end, Vec2 away) const;
  [[nodiscard]] bool is_beside_cut(Vec2 p, Vec2 end, double kerf_mm) const;

  Vec2 sheet_;
  std::vector<Side> sides_;               ///< of all that is cut
  std::vector<std::vector<Vec2>> loops_;  ///< outlines and holes
};

constexpr double end_mm = 4.0;
constexpr double shortest_mm = 0.5;
constexpr double clear_mm = 0.5;  ///< of what is cut beyond
constexpr double on_outline_mm = 0.05;
constexpr double probe_mm = 0.2;
constexpr double beside_mm = 0.3;  ///< nothing is cut so near along the line
constexpr double steepest_beside =
    0.4;  ///< sine of the angle: cuts that leave the line's begin so are beside it

FoldEnds::FoldEnds(const Drawing& page) : sheet_(page.size) {
  for (const Group& group : page.groups) {
    for (const Line& line : group.lines) {
      if (line.layer == Layer::cut) {
        const std::size_t count = line.points.size() - (line.closed ? 0 : 1);
        for (std::size_t i = 0; i < count; ++i) {
          sides_.push_back({line.points[i], line.points[(i + 1) % line.points.size()]});
        }
        if (line.closed) {
          loops_.push_back(line.points);
        }
      }
    }
  }
}

std::optional<std::vector<Vec2>> FoldEnds::beyond(Vec2 end, Vec2 from, double kerf_mm) const {
  const Vec2 away = (end - from) / length(end - from);
  double room = end_mm + clear_mm;
  bool at_outline = false;
  for (const auto& [a, b] : sides_) {
    at_outline = at_outline || distance_to_segment(end, a, b) < on_outline_mm;
    const double turn = cross(away, b - a);
    if (std::abs(turn) > 0.0) {
      const double at = cross(a - end, b - a) / turn;
      const double along = cross(a - end, away) / turn;
      if (at > probe_mm && along >= 0.0 && along <= 1.0) {
        room = std::min(room, at);
      }
    }
  }
  const Vec2 first = end + (0.5 * kerf_mm) * away;
  const Vec2 last = end + std::min(room - clear_mm, room_on_sheet(end, away)) * away;
  if (!at_outline || dot(last - first, away) < shortest_mm || inside(loops_, end + probe_mm * away) ||
      inside(loops_, 0.5 * (first + last)) || is_beside_cut(end + probe_mm * away, end, kerf_mm) ||
      is_beside_cut(0.5 * (first + last), end, kerf_mm) || is_beside_cut(last, end, kerf_mm)) {
    return std::nullopt;
  }
  return std::vector<Vec2>{first, last};
}

double FoldEnds::room_on_sheet(Vec2 end, Vec2 away) const {
  const auto room = [](double at, double step, double size) {
    return step > 0.0 ? (size - at) / step : step < 0.0 ? at / -step : end_mm;
  };
  return std::min(room(end.x, away.x, sheet_.x), room(end.y, away.y, sheet_.y));
}

bool FoldEnds::is_beside_cut(Vec2 p, Vec2 end, double kerf_mm) const {
  const double clear = std::min(beside_mm + 0.5 * kerf_mm, steepest_beside * length(p - end));
  return std::ranges::any_of(sides_, [&](const Side& s) { return distance_to_segment(p, s.a, s.b) < clear; });
}

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
      // Ticks are written as numbers are.
      const bool tick = line.layer == Layer::mark && line.like == Layer::label;
      const auto operation = operation_of(tick ? Layer::label : line.layer);
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

std::vector<std::array<Vec2, 2>> hatching(const std::vector<Vec2>& polygon, double apart_mm) {
  const Vec2 along{0.5 * std::numbers::sqrt2, 0.5 * std::numbers::sqrt2};
  const Vec2 across = perpendicular(along);
  double low = 1e300;
  double high = -1e300;
  for (const Vec2 p : polygon) {
    low = std::min(low, dot(p, across));
    high = std::max(high, dot(p, across));
  }
  std::vector<std::array<Vec2, 2>> lines;
  for (double k = std::ceil(low / apart_mm); k * apart_mm < high; k += 1.0) {
    const double level = k * apart_mm;
    std::vector<double> crossings;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vec2 a = polygon[i];
      const Vec2 b = polygon[(i + 1) % polygon.size()];
      const double at_a = dot(a, across) - level;
      const double at_b = dot(b, across) - level;
      if ((at_a > 0.0) != (at_b > 0.0)) {
        crossings.push_back(dot(a + (at_a / (at_a - at_b)) * (b - a), along));
      }
    }
    std::ranges::sort(crossings);
    for (std::size_t i = 1; i < crossings.size(); i += 2) {
      lines.push_back({crossings[i - 1] * along + level * across, crossings[i] * along + level * across});
    }
  }
  return lines;
}

}  // namespace ridgecraft::export_
