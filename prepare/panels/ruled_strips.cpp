// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/panels/ruled_strips.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

#include "base/no_index.hpp"

namespace ridgecraft::prepare {
namespace {

/// A line while strips are looked for: the sides of the regions on its left that run along it, in order.
struct Line {
  std::vector<CornerId> sides;
  bool closed = false;
  bool tip_first = false;  ///< its first point is a tip
  bool tip_last = false;
};

class Finder {
 public:
  Finder(const mesh::Surface& surface, const PanelRegions& regions, const mesh::LooseFaces& loose)
      : surface_(surface),
        regions_(regions),
        loose_(loose),
        sides_(regions.count(), 0),
        line_of_(surface.edge_count(), no_index) {}

  std::vector<RuledStrip> run() {
    count_sides();
    for (const EdgeId e : ids<EdgeId>(surface_.edge_count())) {
      if (line_of_[e.value()] == no_index && surface_.sides(e)[1].valid() && regions_.on_border(e)) {
        find_line(surface_.sides(e)[0]);
      }
    }
    std::vector<RuledStrip> strips;
    seen_.assign(lines_.size(), false);
    for (std::uint32_t l = 0; l < lines_.size(); ++l) {
      if (!seen_[l]) {
        strips.push_back(strip_of(l));
      }
    }
    return strips;
  }

 private:
  [[nodiscard]] std::uint32_t region(CornerId c) const { return regions_.region(mesh::face_of(c).value()); }
  [[nodiscard]] VertexId start(CornerId c) const { return surface_.vertex(c); }
  [[nodiscard]] VertexId end(CornerId c) const { return surface_.vertex(mesh::next(c)); }
  [[nodiscard]] std::size_t degree(VertexId v) const { return regions_.border_edges(v.value()).size(); }

  /// The side of the same region that goes on where this one ends.
  [[nodiscard]] CornerId next_side(CornerId c) const {
    c = mesh::next(c);
    while (!regions_.on_border(surface_.edge(c))) {
      c = mesh::next(surface_.twin(c));
    }
    return c;
  }
  [[nodiscard]] CornerId side_before(CornerId c) const {
    c = mesh::previous(c);
    while (!regions_.on_border(surface_.edge(c))) {
      c = mesh::previous(surface_.twin(c));
    }
    return c;
  }

  /// Of regions with one outline of three or four sides; 0 for all others.
  void count_sides() {
    std::vector<std::size_t> all(regions_.count(), 0);
    for (const CornerId c : ids<CornerId>(surface_.corner_count())) {
      all[region(c)] += regions_.on_border(surface_.edge(c)) ? 1U : 0U;
    }
    for (const CornerId c : ids<CornerId>(surface_.corner_count())) {
      const std::uint32_t r = region(c);
      if (sides_[r] == 0 && (all[r] == 3 || all[r] == 4) && regions_.on_border(surface_.edge(c))) {
        std::size_t around = 1;
        for (CornerId d = next_side(c); d != c && around <= 4; d = next_side(d)) {
          ++around;
        }
        sides_[r] = around == all[r] ? around : 0;
      }
    }
  }

  enum class Way { on, ends, tip, never };
  struct Step {
    Way way = Way::never;
    CornerId side;
  };

  /// How a line goes on at the end of a side.
  [[nodiscard]] Step step(CornerId c) const {
    const CornerId d = surface_.twin(c);
    const VertexId v = end(c);
    const std::size_t sides = degree(v);
    if (sides_[region(c)] != sides_[region(d)] || sides_[region(c)] == 0) {
      return {};
    }
    if (sides == 3) {
      return {Way::ends, {}};
    }
    if (sides == 4) {
      const CornerId across = surface_.twin(next_side(c));
      const CornerId back = surface_.twin(side_before(d));
      if (!across.valid() || !back.valid()) {
        return {};
      }
      const CornerId on = next_side(across);
      const std::size_t left = sides_[region(on)];
      if (surface_.twin(on) != side_before(back) || left == 0 || left != sides_[region(side_before(back))]) {
        return {};
      }
      return {Way::on, on};
    }
    return {sides_[region(c)] == 3 ? Way::tip : Way::never, {}};
  }

  /// From a side as far as it goes; whether it ends well.
  bool follow(CornerId from, std::vector<CornerId>& sides, Way& last) const {
    CornerId c = from;
    for (;;) {
      const Step next = step(c);
      last = next.way;
      if (next.way != Way::on) {
        return next.way != Way::never;
      }
      if (next.side == from) {
        return true;  // a loop
      }
      if (sides.size() > surface_.edge_count()) {
        return false;  // it runs in circles beside its beginning; not seen in practice
      }
      c = next.side;
      sides.push_back(c);
    }
  }

  void find_line(CornerId from) {
    Line line;
    std::vector<CornerId> ahead{from};
    Way last = Way::never;
    bool fine = follow(from, ahead, last);
    line.closed = fine && last == Way::on;
    line.tip_last = last == Way::tip;
    line.sides = ahead;
    if (fine && !line.closed) {
      std::vector<CornerId> behind{surface_.twin(from)};
      fine = follow(surface_.twin(from), behind, last) && last != Way::on;
      line.tip_first = last == Way::tip;
      line.sides.clear();
      for (std::size_t i = behind.size(); i-- > 1;) {
        line.sides.push_back(surface_.twin(behind[i]));
      }
      line.sides.insert(line.sides.end(), ahead.begin(), ahead.end());
    }
    fine =
        fine && std::all_of(line.sides.begin(), line.sides.end(), [&](CornerId c) { return looks_same(c); });
    if (fine && has_tips_at_ends_alone(line)) {
      for (const CornerId c : line.sides) {
        line_of_[surface_.edge(c).value()] = static_cast<std::uint32_t>(lines_.size());
      }
      lines_.push_back(std::move(line));
    }
  }

  /// Whether both sides have one material and are of one object.
  [[nodiscard]] bool looks_same(CornerId c) const {
    const std::uint32_t f = mesh::face_of(c).value();
    const std::uint32_t g = mesh::face_of(surface_.twin(c)).value();
    return (loose_.material.empty() || loose_.material[f] == loose_.material[g]) &&
           (loose_.object.empty() || loose_.object[f] == loose_.object[g]);
  }

  /// Triangles are the tiers at tips, all others have four sides.
  [[nodiscard]] bool has_tips_at_ends_alone(const Line& line) const {
    const std::size_t count = line.sides.size();
    if (count == 1 && line.tip_first && line.tip_last) {
      return false;
    }
    for (std::size_t t = 0; t < count; ++t) {
      const bool at_tip = (t == 0 && line.tip_first) || (t + 1 == count && line.tip_last);
      if (sides_[region(line.sides[t])] != (at_tip ? 3U : 4U)) {
        return false;
      }
    }
    return true;
  }

  /// The next line on the left: its sides in the same direction, none where the surface ends there; and its
  /// points.
  struct Beside {
    std::vector<CornerId> sides;
    RulingLine line;
  };
  [[nodiscard]] Beside beside(const Line& line) const {
    Beside result;
    bool all = true;
    const std::size_t count = line.sides.size();
    for (std::size_t t = 0; t < count; ++t) {
      const CornerId c = line.sides[t];
      const bool tip_at_end = t + 1 == count && line.tip_last;
      const CornerId opposite = tip_at_end ? next_side(c) : next_side(next_side(c));
      if (t == 0) {
        result.line.points.push_back(end(opposite).value());
      }
      if (!line.closed || t + 1 < count) {
        result.line.points.push_back(start(opposite).value());
      }
      const CornerId on_left = surface_.twin(opposite);
      all = all && on_left.valid();
      result.sides.push_back(on_left);
      result.line.fold = std::max(result.line.fold, std::abs(surface_.fold_angle(surface_.edge(opposite))));
    }
    if (!all) {
      result.sides.clear();
    }
    return result;
  }

  /// The line that these sides are, as one that could go; none where they aren't.
  [[nodiscard]] std::uint32_t line_along(const std::vector<CornerId>& sides, bool closed) const {
    if (sides.empty()) {
      return no_index;
    }
    const std::uint32_t line = line_of_[surface_.edge(sides.front()).value()];
    const bool same = line != no_index && lines_[line].sides.size() == sides.size() &&
                      lines_[line].closed == closed &&
                      std::all_of(sides.begin(), sides.end(),
                                  [&](CornerId c) { return line_of_[surface_.edge(c).value()] == line; });
    return same ? line : no_index;
  }

  [[nodiscard]] Line turned_around(const Line& line) const {
    Line result;
    for (std::size_t t = line.sides.size(); t-- > 0;) {
      result.sides.push_back(surface_.twin(line.sides[t]));
    }
    result.closed = line.closed;
    result.tip_first = line.tip_last;
    result.tip_last = line.tip_first;
    return result;
  }

  [[nodiscard]] RulingLine points_of(const Line& line) const {
    RulingLine result;
    result.points.push_back(start(line.sides.front()).value());
    for (std::size_t t = 0; t < line.sides.size(); ++t) {
      if (!line.closed || t + 1 < line.sides.size()) {
        result.points.push_back(end(line.sides[t]).value());
      }
      result.fold = std::max(result.fold, std::abs(surface_.fold_angle(surface_.edge(line.sides[t]))));
    }
    return result;
  }

  [[nodiscard]] std::vector<std::uint32_t> regions_left_of(const Line& line) const {
    std::vector<std::uint32_t> result;
    for (const CornerId c : line.sides) {
      result.push_back(region(c));
    }
    return result;
  }

  /// Goes left from a line, which is the strip's last so far; true where it comes round to the first one.
  bool extend(RuledStrip& strip, Line line, std::uint32_t first) {
    for (;;) {
      Beside next = beside(line);
      strip.regions.push_back(regions_left_of(line));
      const std::uint32_t at = line_along(next.sides, line.closed);
      if (at == first) {
        return true;
      }
      strip.lines.push_back(std::move(next.line));
      if (at == no_index || seen_[at]) {
        return false;
      }
      seen_[at] = true;
      line.sides = std::move(next.sides);
    }
  }

  RuledStrip strip_of(std::uint32_t first) {
    RuledStrip strip;
    const Line& line = lines_[first];
    seen_[first] = true;
    strip.loops = line.closed;
    strip.lines.push_back(points_of(line));
    strip.round = extend(strip, line, first);
    if (!strip.round) {
      // To the right of the first one, seen from behind: then all of it the other way round.
      RuledStrip right;
      extend(right, turned_around(line), first);
      for (RulingLine& other : right.lines) {
        std::reverse(other.points.begin(), other.points.end());
        if (strip.loops) {
          // A loop read backwards begins at the same point.
          std::rotate(other.points.begin(), other.points.end() - 1, other.points.end());
        }
      }
      for (auto& between : right.regions) {
        std::reverse(between.begin(), between.end());
      }
      std::reverse(right.lines.begin(), right.lines.end());
      std::reverse(right.regions.begin(), right.regions.end());
      strip.lines.insert(strip.lines.begin(), right.lines.begin(), right.lines.end());
      strip.regions.insert(strip.regions.begin(), right.regions.begin(), right.regions.end());
    }
    return strip;
  }

  const mesh::Surface& surface_;
  const PanelRegions& regions_;
  const mesh::LooseFaces& loose_;
  std::vector<std::size_t> sides_;      ///< of each region
  std::vector<std::uint32_t> line_of_;  ///< of each edge: the line that could go and that it is part of
  std::vector<Line> lines_;
  std::vector<bool> seen_;  ///< lines that are part of a strip
};

}  // namespace

std::vector<RuledStrip> ruled_strips(const mesh::Surface& surface, const PanelRegions& regions,
                                     const mesh::LooseFaces& loose) {
  return Finder(surface, regions, loose).run();
}

}  // namespace ridgecraft::prepare
