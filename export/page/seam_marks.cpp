// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/page/seam_marks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/elementary.hpp"
#include "export/page/lines.hpp"

namespace ridgecraft::export_ {
namespace {

/// Two edges that bend less than this (10 degrees) look like one.
constexpr double straight_cosine = 0.985;
/// Where an outline turns by more than this (60 degrees) the eye doesn't follow an edge around the corner.
constexpr double sharp_cosine = 0.5;
/// A chain has a number about so often, mm.
constexpr double number_distance = 40.0;
/// What is shorter between two sharp corners shares the number of what is next to it, mm.
constexpr double shortest_numbered = 10.0;
/// Edges from this length on have ticks, about as far from each other as numbers are, mm.
constexpr double long_edge = 1.5 * number_distance;
/// What marks the end of a chain, and what a place within it, mm: shorter than any fold, longer than a slip
/// of the pen.
constexpr double chain_end_tick = 2.0;
constexpr double within_chain_tick = 1.1;
constexpr Pen tick_pen{0.15, {}};  // darker than leaders: ticks are short
/// Ends of lines that are one point on paper, mm.
constexpr double near_mm = 0.05;

Vec2 along(const Seam& seam) {
  return seam.edge.b - seam.edge.a;
}

/// Of the angle between two edges that follow each other: 1 where they are straight.
double cosine(const Seam& first, const Seam& second) {
  const double size = length(along(first)) * length(along(second));
  return size > 0.0 ? dot(along(first), along(second)) / size : 1.0;
}

double length_of(const PieceDrawing& piece, const std::vector<std::size_t>& seams) {
  double sum = 0.0;
  for (const std::size_t seam : seams) {
    sum += length(along(piece.seams[seam]));
  }
  return sum;
}

/// A side of a chain cut at sharp corners, but for what is too short between them.
std::vector<std::vector<std::size_t>> stretches_of(const PieceDrawing& piece,
                                                   const std::vector<std::size_t>& side) {
  std::vector<std::vector<std::size_t>> stretches;
  for (const std::size_t seam : side) {
    if (stretches.empty() || cosine(piece.seams[stretches.back().back()], piece.seams[seam]) < sharp_cosine) {
      stretches.emplace_back();
    }
    stretches.back().push_back(seam);
  }
  std::vector<std::vector<std::size_t>> long_ones;
  for (const std::vector<std::size_t>& stretch : stretches) {
    if (!long_ones.empty() &&
        std::min(length_of(piece, stretch), length_of(piece, long_ones.back())) < shortest_numbered) {
      long_ones.back().insert(long_ones.back().end(), stretch.begin(), stretch.end());
    } else {
      long_ones.push_back(stretch);
    }
  }
  return long_ones;
}

/// One number for about every 40 mm of these edges.
void part_row(const PieceDrawing& piece, const NumberedRow& row, std::vector<NumberedRow>& rows) {
  const double all = length_of(piece, row.seams);
  const auto wanted = static_cast<std::size_t>(std::max(1.0, std::round(all / number_distance)));
  const std::size_t count = std::min(wanted, row.seams.size());
  std::vector<NumberedRow> parts(count, {row.side, {}});
  double at = 0.0;
  for (const std::size_t seam : row.seams) {
    const double size = length(along(piece.seams[seam]));
    const double middle = at + 0.5 * size;
    at += size;
    const double part = all > 0.0 ? std::floor(middle / all * static_cast<double>(count)) : 0.0;
    parts[std::min(count - 1, static_cast<std::size_t>(part))].seams.push_back(seam);
  }
  for (NumberedRow& part : parts) {
    if (!part.seams.empty()) {
      rows.push_back(std::move(part));
    }
  }
}

class TickMaker {
 public:
  explicit TickMaker(PieceDrawing& piece) : piece_(piece), at_(piece.seams.size()) {
    for (std::size_t side = 0; side < piece.sides.size(); ++side) {
      for (std::size_t i = 0; i < piece.sides[side].size(); ++i) {
        at_[piece.sides[side][i]] = {side, i, true};
      }
    }
    for (const NumberedRow& row : numbered_rows(piece)) {
      bool turns = false;
      for (std::size_t i = 1; i < row.seams.size(); ++i) {
        turns = turns || cosine(piece.seams[row.seams[i - 1]], piece.seams[row.seams[i]]) < sharp_cosine;
      }
      for (const std::size_t seam : row.seams) {
        at_[seam].shares = row.seams.size() > 1;
        at_[seam].turns = turns;
      }
    }
  }

  void make() {
    for (const auto& rim : piece_.rims) {
      for (std::size_t i = 0; i < rim.size(); ++i) {
        mark_corner(rim[(i + 1) % rim.size()], rim[i]);  // clockwise, and edges run the other way
      }
    }
    for (const Seam& seam : piece_.seams) {
      mark_long_edge(seam);
    }
  }

 private:
  struct Place {
    std::size_t side = 0;
    std::size_t index = 0;
    bool shares = false;  ///< its number with other edges
    bool turns = false;   ///< these go around a sharp corner
  };

  void mark_corner(std::size_t first, std::size_t second) {
    const Seam& before = piece_.seams[first];
    const Seam& after = piece_.seams[second];
    if (length(before.edge.b - after.edge.a) > same_corner_mm) {
      return;  // a border lies between them
    }
    const double turn = cosine(before, after);
    const bool same_side = at_[first].side == at_[second].side;
    if (same_side && at_[second].index == at_[first].index + 1) {
      if (turn > straight_cosine && directions_at(after.edge.a).empty() && !has_tick(after.edge.a)) {
        add_tick(after.edge.a, across(before, after), within_chain_tick);
      }
    } else if (same_side ? first != second : before.number != after.number) {
      mark_end(first, second, turn);
    }
  }

  /// A chain that closes has one wherever it begins. Others need none where the corner can be seen and either
  /// is sharp, with the numbers of what it parts on either side, or both edges have their own numbers.
  void mark_end(std::size_t first, std::size_t second, double turn) {
    const Seam& before = piece_.seams[first];
    const Seam& after = piece_.seams[second];
    const Place& one = at_[first];
    const Place& other = at_[second];
    const std::vector<Vec2> folds = directions_at(after.edge.a);
    const bool seen = turn < straight_cosine || !folds.empty();
    const bool parts = turn < sharp_cosine && !one.turns && !other.turns;
    if (one.side != other.side && seen && (parts || (!one.shares && !other.shares))) {
      return;
    }
    add_tick(after.edge.a, folds.empty() ? across(before, after) : widest_gap(before, after, folds),
             chain_end_tick);
  }

  void mark_long_edge(const Seam& seam) {
    const double size = length(along(seam));
    if (size < long_edge) {
      return;
    }
    const int parts = static_cast<int>(std::round(size / number_distance));
    for (int i = 1; i < parts; ++i) {
      add_tick(seam.edge.a + along(seam) * i / parts, perpendicular(along(seam)) / size, within_chain_tick);
    }
  }

  /// Into the piece, between two edges.
  static Vec2 across(const Seam& before, const Seam& after) {
    return half_turn(along(after) / length(along(after)), -along(before) / length(along(before)));
  }

  /// The direction half-way from one to the other, counterclockwise; both have length 1.
  static Vec2 half_turn(Vec2 from, Vec2 to) {
    const double angle = 0.5 * turn(from, to);
    return elementary::cos(angle) * from + elementary::sin(angle) * perpendicular(from);
  }

  /// From one direction counterclockwise to another, radians.
  static double turn(Vec2 from, Vec2 to) {
    const double angle = elementary::atan2(cross(from, to), dot(from, to));
    return angle > 0.0 ? angle : angle + 2.0 * std::numbers::pi;
  }

  /// The middle of the widest angle that folds leave at a corner.
  static Vec2 widest_gap(const Seam& before, const Seam& after, std::vector<Vec2> folds) {
    const Vec2 first = along(after) / length(along(after));
    const Vec2 last = -along(before) / length(along(before));
    std::erase_if(folds, [&](Vec2 fold) { return turn(first, fold) >= turn(first, last); });
    std::ranges::sort(folds, {}, [&](Vec2 fold) { return turn(first, fold); });
    folds.push_back(last);
    Vec2 from = first;
    std::pair best{first, folds.front()};
    for (const Vec2 to : folds) {
      if (turn(from, to) > turn(best.first, best.second)) {
        best = {from, to};
      }
      from = to;
    }
    return half_turn(best.first, best.second);
  }

  /// Of folds, those of tabs among them, that end at a point.
  [[nodiscard]] std::vector<Vec2> directions_at(Vec2 p) const {
    std::vector<Vec2> directions;
    for (const Line& line : piece_.group.lines) {
      if (line.layer != Layer::mountain && line.layer != Layer::valley && line.layer != Layer::tab_fold) {
        continue;
      }
      const std::array ends{line.points.front(), line.points.back()};
      for (const std::size_t k : {0U, 1U}) {
        const Vec2 way = ends[1 - k] - ends[k];
        if (length(ends[k] - p) < near_mm && length(way) > 0.0) {
          directions.push_back(way / length(way));
        }
      }
    }
    return directions;
  }

  [[nodiscard]] bool has_tick(Vec2 p) const {
    return std::ranges::any_of(piece_.group.lines, [&](const Line& line) {
      return line.layer == Layer::mark && length(line.points.front() - p) < near_mm;
    });
  }

  void add_tick(Vec2 at, Vec2 direction, double size) {
    Line tick{Layer::mark, {at, at + size * direction}, false, Fold::none};
    tick.like = Layer::label;
    tick.pen = tick_pen;
    piece_.group.lines.push_back(std::move(tick));
  }

  PieceDrawing& piece_;
  std::vector<Place> at_;  ///< of each seam
};

}  // namespace

std::vector<NumberedRow> numbered_rows(const PieceDrawing& piece) {
  std::vector<NumberedRow> rows;
  for (std::size_t side = 0; side < piece.sides.size(); ++side) {
    for (const std::vector<std::size_t>& seams : stretches_of(piece, piece.sides[side])) {
      part_row(piece, {side, seams}, rows);
    }
  }
  return rows;
}

void add_ticks(PieceDrawing& piece) {
  TickMaker(piece).make();
}

}  // namespace ridgecraft::export_
