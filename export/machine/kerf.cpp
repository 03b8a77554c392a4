// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/machine/kerf.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>

#include <boost/polygon/polygon.hpp>
#include <boost/polygon/voronoi.hpp>

#include "base/boxes.hpp"
#include "base/geometry.hpp"

namespace ridgecraft::export_ {
namespace {

namespace planar = boost::polygon;
using PlanarPoint = planar::point_data<int>;
using PlanarPolygon = planar::polygon_data<int>;
using PlanarSet = planar::polygon_set_data<int>;
using PlanarSegment = planar::segment_data<int>;

/// Of the grid on which loops are added up; coarser for what is larger than 10 m, as it has 32 bits.
constexpr double cells_per_mm = 1e5;
constexpr double most_cells = 1e9;
/// Corners nearer than this to the line between their neighbours come of rounding, mm.
constexpr double straight_mm = 3e-5;
/// What moved loops leave of a gap is no gap where it is narrower than twice this: its sides would be cut
/// beside each other, mm.
constexpr double sliver_mm = 0.025;
/// How far beyond half of the kerf paper may lie that isn't cut, mm.
constexpr double reach_mm = 0.05;
/// A line in a gap that is shorter begins farther out, mm: a path as short would be left out.
constexpr double shortest_line_mm = shortest_path_mm + 0.01;

struct Grid {
  Vec2 origin;
  double cells = cells_per_mm;  ///< a mm

  [[nodiscard]] PlanarPoint operator()(Vec2 p) const {
    return {static_cast<int>(std::lround(cells * (p.x - origin.x))),
            static_cast<int>(std::lround(cells * (p.y - origin.y)))};
  }
  [[nodiscard]] Vec2 operator()(PlanarPoint p) const {
    return (*this)(static_cast<double>(p.x()), static_cast<double>(p.y()));
  }
  [[nodiscard]] Vec2 operator()(double x, double y) const { return origin + Vec2{x, y} / cells; }
};

Grid grid_for(const std::vector<std::vector<Vec2>>& loops) {
  const Box2 box = box_of(loops);
  if (box.empty()) {
    return {};
  }
  const double size = std::max({box.size().x, box.size().y, 1.0});
  return {0.5 * (box.low + box.high), std::min(cells_per_mm, most_cells / size)};
}

/// Loops moved away from what they bound. No corner's mitre reaches farther than `reach`, at least the
/// distance.
class Mover {
 public:
  Mover(const std::vector<std::vector<Vec2>>& loops, double distance, double reach)
      : loops_(loops), distance_(distance), reach_(reach / distance), grid_(grid_for(loops)) {}

  std::vector<std::vector<Vec2>> moved() {
    for (std::size_t i = 0; i < loops_.size(); ++i) {
      add_inside(i);
      for (std::size_t k = 0; k < loops_[i].size(); ++k) {
        add_strip(loops_[i], k);
        add_corner(loops_[i], k);
      }
    }
    std::vector<planar::polygon_with_holes_data<int>> areas;
    set_.get(areas);
    std::vector<std::vector<Vec2>> result;
    for (const auto& area : areas) {
      add_loop(area, true, result);
      for (auto hole = area.begin_holes(); hole != area.end_holes(); ++hole) {
        add_loop(*hole, false, result);
      }
    }
    return result;
  }

 private:
  void add(const std::vector<Vec2>& polygon, bool is_hole = false) {
    std::vector<PlanarPoint> points;
    points.reserve(polygon.size());
    std::ranges::transform(polygon, std::back_inserter(points), grid_);
    set_.insert(PlanarPolygon(points.begin(), points.end()), is_hole);
  }
  /// The outer loop runs against the clock, holes with it.
  void add_inside(std::size_t i) { add(loops_[i], doubled_area(loops_[i]) < 0.0); }

  void add_strip(const std::vector<Vec2>& loop, std::size_t k) {
    const Vec2 a = loop[k];
    const Vec2 b = loop[(k + 1) % loop.size()];
    if (const Vec2 out = outward(a, b); length(out) > 0.0) {
      add({a, a + out, b + out, b});
    }
  }

  /// Between the strips of two sides, where the paper has a corner that points outwards.
  void add_corner(const std::vector<Vec2>& loop, std::size_t k) {
    const Vec2 before = loop[(k + loop.size() - 1) % loop.size()];
    const Vec2 at = loop[k];
    const Vec2 after = loop[(k + 1) % loop.size()];
    const Vec2 one = outward(before, at) / distance_;
    const Vec2 two = outward(at, after) / distance_;
    if (!(cross(one, two) > 0.0 || (dot(one, two) < 0.0 && cross(one, two) >= 0.0))) {
      return;
    }
    const Vec2 middle = one + two;
    const double size = length(middle);
    // The mitre lies 2 / |one + two| times the distance from the corner.
    if (size * reach_ >= 2.0) {
      add({at, at + distance_ * one, at + (2.0 * distance_ / (size * size)) * middle, at + distance_ * two});
      return;
    }
    // Cut off across the end. Where the sides lie on each other their sum has no direction.
    const Vec2 along = size > 1e-9 ? middle / size : perpendicular(one);
    const auto cut_off = [&](Vec2 normal, double turn) {
      // On the side's moved line, as far along the middle as a mitre may reach.
      const double up = dot(normal, along);
      const Vec2 across = turn * perpendicular(along);
      const double right = dot(normal, across);
      return at + distance_ * (reach_ * along + ((1.0 - reach_ * up) / right) * across);
    };
    add({at, at + distance_ * one, cut_off(one, -1.0), cut_off(two, 1.0), at + distance_ * two});
  }

  /// The paper lies on the left of a side.
  [[nodiscard]] Vec2 outward(Vec2 a, Vec2 b) const {
    const double size = length(b - a);
    return size > 0.0 ? (-distance_ / size) * perpendicular(b - a) : Vec2{};
  }

  template <class Polygon>
  void add_loop(const Polygon& polygon, bool outer, std::vector<std::vector<Vec2>>& result) const {
    std::vector<Vec2> points;
    for (const PlanarPoint& p : polygon) {
      if (points.empty() || length(grid_(p) - points.back()) > 0.0) {
        points.push_back(grid_(p));
      }
    }
    while (points.size() > 1 && !(length(points.front() - points.back()) > 0.0)) {
      points.pop_back();
    }
    std::vector<Vec2> corners;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vec2 before = corners.empty() ? points.back() : corners.back();
      const Vec2 after = points[(i + 1) % points.size()];
      const double size = length(after - before);
      if (!(size > 0.0) || std::abs(cross(after - before, points[i] - before)) > straight_mm * size) {
        corners.push_back(points[i]);
      }
    }
    if (corners.size() > 2) {
      if ((doubled_area(corners) > 0.0) != outer) {
        std::ranges::reverse(corners);
      }
      result.push_back(std::move(corners));
    }
  }

  const std::vector<std::vector<Vec2>>& loops_;
  double distance_;
  double reach_;  ///< in distances
  Grid grid_;
  PlanarSet set_;
};

/// What lies around a piece, up to a frame: the loops the other way round, and the frame first.
std::vector<std::vector<Vec2>> surroundings(const std::vector<std::vector<Vec2>>& loops, double width) {
  std::vector<std::vector<Vec2>> result(1);
  for (std::vector<Vec2> loop : loops) {
    std::ranges::reverse(loop);
    result.push_back(std::move(loop));
  }
  const Box2 frame = grown(box_of(loops), width);
  result[0] = {frame.low, {frame.high.x, frame.low.y}, frame.high, {frame.low.x, frame.high.y}};
  return result;
}

/// Loops moved by the distance; what is left of gaps is wider than a sliver.
std::vector<std::vector<Vec2>> moved_without_slivers(const std::vector<std::vector<Vec2>>& loops,
                                                     double distance) {
  const std::vector<std::vector<Vec2>> beyond =
      Mover(loops, distance + sliver_mm, 2.0 * distance + sliver_mm).moved();
  if (beyond.empty()) {
    return {};
  }
  std::vector<std::vector<Vec2>> back = Mover(surroundings(beyond, 1.0), sliver_mm, 2.0 * sliver_mm).moved();
  std::vector<std::vector<Vec2>> result;
  for (std::vector<Vec2>& loop : back) {
    std::ranges::reverse(loop);
    result.push_back(std::move(loop));
  }
  // The frame bounds all else.
  const auto frame =
      std::ranges::min_element(result, {}, [](const std::vector<Vec2>& loop) { return doubled_area(loop); });
  if (frame != result.end()) {
    result.erase(frame);
  }
  // Outlines before holes, as they are given.
  std::ranges::stable_partition(result,
                                [](const std::vector<Vec2>& loop) { return doubled_area(loop) > 0.0; });
  return result;
}

/// Lines in the middle of gaps that are narrower than twice the distance.
class GapLines {
 public:
  GapLines(const std::vector<std::vector<Vec2>>& loops, double distance)
      : loops_(loops), distance_(distance), grid_(grid_for(loops)) {
    for (const std::vector<Vec2>& loop : loops) {
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const PlanarSegment side(grid_(loop[i]), grid_(loop[(i + 1) % loop.size()]));
        if (side.low() != side.high()) {
          sides_.push_back(side);
        }
      }
    }
    piece_sides_ = sides_.size();
    add_frame();
  }

  std::vector<std::vector<Vec2>> lines() {
    // The diagram is defined for sides that meet at their ends alone. They do, but for rounding in needles.
    if (sides_cross()) {
      return {};
    }
    planar::voronoi_diagram<double> diagram;
    planar::construct_voronoi(sides_.begin(), sides_.end(), &diagram);
    for (const auto& edge : diagram.edges()) {
      if (edge.is_primary() && edge.is_finite() && &edge < edge.twin()) {
        add_edge(edge);
      }
    }
    return chains();
  }

 private:
  using Diagram = planar::voronoi_diagram<double>;
  /// A place where stretches meet: a vertex of the diagram, or where a gap is as wide as the kerf (each such
  /// end is one of its own).
  using Node = std::size_t;
  struct Stretch {
    Node from;
    Node to;
    std::vector<Vec2> points;
  };

  /// Around all, so that no edge near the piece goes on without end.
  void add_frame() {
    const Box2 box = box_of(loops_);
    const Vec2 away{10.0 + 10.0 * distance_, 10.0 + 10.0 * distance_};
    const PlanarPoint low = grid_(box.low - away);
    const PlanarPoint high = grid_(box.high + away);
    const PlanarPoint right(high.x(), low.y());
    const PlanarPoint left(low.x(), high.y());
    for (const auto& [a, b] : {std::pair(low, right), {right, high}, {high, left}, {left, low}}) {
      sides_.emplace_back(a, b);
    }
  }

  [[nodiscard]] bool sides_cross() const {
    std::vector<Box3> boxes(piece_sides_);
    for (std::size_t i = 0; i < piece_sides_; ++i) {
      for (const Vec2 p : {grid_(sides_[i].low()), grid_(sides_[i].high())}) {
        boxes[i].add({p.x, p.y, 0.0});
      }
    }
    bool crossing = false;
    NearBoxes(boxes).for_pairs(
        [&](std::uint32_t i, std::uint32_t j) { crossing = crossing || meet_within(sides_[i], sides_[j]); });
    return crossing;
  }
  /// Whether two sides have a point in common that isn't an end of both.
  static bool meet_within(const PlanarSegment& s, const PlanarSegment& t) {
    const auto side = [](const PlanarSegment& of, PlanarPoint p) {
      // Exact: differences have 31 bits, their products 62.
      const auto x = [](PlanarPoint q) { return static_cast<std::int64_t>(q.x()); };
      const auto y = [](PlanarPoint q) { return static_cast<std::int64_t>(q.y()); };
      const std::int64_t left = (x(of.high()) - x(of.low())) * (y(p) - y(of.low()));
      const std::int64_t right = (y(of.high()) - y(of.low())) * (x(p) - x(of.low()));
      return left > right ? 1 : left < right ? -1 : 0;
    };
    const auto is_end = [](const PlanarSegment& of, PlanarPoint p) {
      return p == of.low() || p == of.high();
    };
    const int a = side(s, t.low());
    const int b = side(s, t.high());
    const int c = side(t, s.low());
    const int d = side(t, s.high());
    if (a * b < 0 && c * d < 0) {
      return true;
    }
    const auto on = [&](const PlanarSegment& of, PlanarPoint p, int where) {
      return where == 0 && !is_end(of, p) && std::min(of.low().x(), of.high().x()) <= p.x() &&
             p.x() <= std::max(of.low().x(), of.high().x()) &&
             std::min(of.low().y(), of.high().y()) <= p.y() && p.y() <= std::max(of.low().y(), of.high().y());
    };
    return on(s, t.low(), a) || on(s, t.high(), b) || on(t, s.low(), c) || on(t, s.high(), d) ||
           (is_end(s, t.low()) && is_end(s, t.high()));
  }

  [[nodiscard]] Vec2 place(const Diagram::vertex_type& v) const { return grid_(v.x(), v.y()); }

  /// What a cell is nearest to: a side, or one of its ends.
  struct Source {
    Vec2 a;
    Vec2 b;
    bool point = false;
  };
  [[nodiscard]] Source source_of(const Diagram::cell_type& cell) const {
    const PlanarSegment& side = sides_[cell.source_index()];
    const Vec2 low = grid_(side.low());
    const Vec2 high = grid_(side.high());
    if (!cell.contains_point()) {
      return {low, high};
    }
    const bool start = cell.source_category() == planar::SOURCE_CATEGORY_SEGMENT_START_POINT;
    return start ? Source{low, low, true} : Source{high, high, true};
  }

  /// Points of an edge, its ends first and last: a stretch of a straight line or of a parabola.
  [[nodiscard]] std::vector<Vec2> points_of(const Diagram::edge_type& edge) const {
    constexpr int steps = 8;
    const Vec2 from = place(*edge.vertex0());
    const Vec2 to = place(*edge.vertex1());
    const Source one = source_of(*edge.cell());
    const Source two = source_of(*edge.twin()->cell());
    if (!one.point && !two.point) {
      return {from, to};
    }
    std::vector<Vec2> points{from};
    for (int i = 1; i < steps; ++i) {
      const double fraction = static_cast<double>(i) / steps;
      Vec2 p = from + fraction * (to - from);
      if (edge.is_curved()) {
        // As far from the point as from the line.
        const Source& focus = one.point ? one : two;
        const Source& line = one.point ? two : one;
        const Vec2 along = (line.b - line.a) / length(line.b - line.a);
        const Vec2 up = perpendicular(along);
        const double height = dot(focus.a - line.a, up);
        const double x = dot(p - line.a, along);
        const double beside = x - dot(focus.a - line.a, along);
        p = line.a + x * along + ((beside * beside + height * height) / (2.0 * height)) * up;
      }
      points.push_back(p);
    }
    points.push_back(to);
    return points;
  }

  /// Whether a point of an edge of the diagram lies in the paper. That is on the left of sides, and what is
  /// nearest to a point within a side lies beside it.
  [[nodiscard]] bool in_paper(const Diagram::edge_type& edge, Vec2 p) const {
    for (const auto* cell : {edge.cell(), edge.twin()->cell()}) {
      if (const Source side = source_of(*cell); !side.point) {
        return cross(side.b - side.a, p - side.a) > 0.0;
      }
    }
    return inside(loops_, p);
  }

  void add_edge(const Diagram::edge_type& edge) {
    if (std::max(edge.cell()->source_index(), edge.twin()->cell()->source_index()) >= piece_sides_) {
      return;  // beside the frame
    }
    const Source source = source_of(*edge.cell());
    const std::vector<Vec2> points = points_of(edge);
    std::vector<double> room;
    for (const Vec2 p : points) {
      room.push_back(distance_to_segment(p, source.a, source.b));
    }
    const Vec2 middle = 0.5 * (points[points.size() / 2 - 1] + points[points.size() / 2]);
    if (*std::ranges::min_element(room) >= distance_ || in_paper(edge, middle)) {
      return;
    }
    Stretch stretch;
    const auto close = [&](Node node) {
      stretch.to = node;
      if (stretch.points.size() > 1) {
        stretches_.push_back(stretch);
      }
      stretch.points.clear();
    };
    if (room[0] < distance_) {
      stretch = {node_of(edge.vertex0()), 0, {points[0]}};
    }
    for (std::size_t i = 1; i < points.size(); ++i) {
      const bool was = room[i - 1] < distance_;
      const bool is = room[i] < distance_;
      if (was != is) {
        const double fraction = (distance_ - room[i - 1]) / (room[i] - room[i - 1]);
        const Vec2 at = points[i - 1] + fraction * (points[i] - points[i - 1]);
        if (was) {
          stretch.points.push_back(at);
          close(new_exit());
        } else {
          stretch = {new_exit(), 0, {at}};
        }
      }
      if (is) {
        stretch.points.push_back(points[i]);
      }
    }
    if (room.back() < distance_) {
      close(node_of(edge.vertex1()));
    }
  }

  Node node_of(const Diagram::vertex_type* vertex) {
    const auto [found, is_new] = nodes_.try_emplace(vertex, is_exit_.size());
    if (is_new) {
      is_exit_.push_back(false);
    }
    return found->second;
  }
  Node new_exit() {
    is_exit_.push_back(true);
    return is_exit_.size() - 1;
  }

  /// Stretches that follow each other as one line. What is as short as the beam reaches anyway is left out.
  std::vector<std::vector<Vec2>> chains() {
    std::vector<std::vector<std::size_t>> at(is_exit_.size());
    for (std::size_t i = 0; i < stretches_.size(); ++i) {
      at[stretches_[i].from].push_back(i);
      at[stretches_[i].to].push_back(i);
    }
    drop_what_is_reached(at);
    std::vector<std::vector<Vec2>> lines;
    std::vector<bool> used(stretches_.size(), false);
    const auto follow = [&](std::size_t first, Node node) {
      std::vector<Vec2> line;
      const Node begin = node;
      std::size_t i = first;
      while (true) {
        used[i] = true;
        std::vector<Vec2> points = stretches_[i].points;
        if (stretches_[i].from != node) {
          std::ranges::reverse(points);
        }
        line.insert(line.end(), points.begin() + (line.empty() ? 0 : 1), points.end());
        node = stretches_[i].from == node ? stretches_[i].to : stretches_[i].from;
        const auto next = std::ranges::find_if(at[node], [&](std::size_t k) { return !used[k]; });
        if (at[node].size() != 2 || next == at[node].end()) {
          break;
        }
        i = *next;
      }
      lengthen(line, is_exit_[begin], is_exit_[node]);
      lines.push_back(std::move(line));
    };
    for (Node node = 0; node < at.size(); ++node) {
      for (const std::size_t i : at[node]) {
        if (at[node].size() != 2 && !used[i] && wanted_[i]) {
          follow(i, node);
        }
      }
    }
    for (std::size_t i = 0; i < stretches_.size(); ++i) {
      if (!used[i] && wanted_[i]) {
        follow(i, stretches_[i].from);
      }
    }
    return lines;
  }

  /// Lines that hang together and whose length together is within the beam's reach of where the loops begin.
  void drop_what_is_reached(const std::vector<std::vector<std::size_t>>& at) {
    wanted_.assign(stretches_.size(), false);
    std::vector<bool> seen(stretches_.size(), false);
    for (std::size_t first = 0; first < stretches_.size(); ++first) {
      std::vector<std::size_t> together;
      std::vector<std::size_t> open{first};
      double sum = 0.0;
      while (!open.empty()) {
        const std::size_t i = open.back();
        open.pop_back();
        if (seen[i]) {
          continue;
        }
        seen[i] = true;
        together.push_back(i);
        sum += length_of(stretches_[i].points);
        for (const Node node : {stretches_[i].from, stretches_[i].to}) {
          open.insert(open.end(), at[node].begin(), at[node].end());
        }
      }
      for (const std::size_t i : together) {
        // Where slivers are taken away, loops reach farther in again: to the mitre of a corner, or to its
        // limit.
        const double back = std::min(sliver_mm * sum / distance_, 2.0 * sliver_mm);
        wanted_[i] = sum - back > distance_ - sliver_mm + reach_mm;
      }
    }
  }

  /// A line that is too short for a machine begins farther out in its gap.
  static void lengthen(std::vector<Vec2>& line, bool exit_first, bool exit_last) {
    const double missing = shortest_line_mm - length_of(line);
    if (missing <= 0.0 || exit_first == exit_last) {
      return;
    }
    if (exit_first) {
      std::ranges::reverse(line);
    }
    // From the tip, as a short last stretch has hardly a direction.
    const Vec2 along = line.back() - line.front();
    line.back() += (missing / std::max(length(along), 1e-9)) * along;
  }

  const std::vector<std::vector<Vec2>>& loops_;
  double distance_;
  Grid grid_;
  std::vector<PlanarSegment> sides_;
  std::size_t piece_sides_ = 0;
  std::map<const Diagram::vertex_type*, Node> nodes_;
  std::vector<bool> is_exit_;
  std::vector<Stretch> stretches_;
  std::vector<bool> wanted_;
};

}  // namespace

CutPaths with_kerf(const std::vector<std::vector<Vec2>>& loops, double kerf_mm) {
  if (!(kerf_mm > 0.0)) {
    return {loops, {}};
  }
  const double distance = 0.5 * kerf_mm;
  return {moved_without_slivers(loops, distance), GapLines(loops, distance + sliver_mm).lines()};
}

}  // namespace ridgecraft::export_
