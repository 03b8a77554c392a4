// SPDX-License-Identifier: GPL-3.0-or-later
// What the knife cuts: lengths, and pieces that it can't cut out or that fall apart.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "base/geometry.hpp"
#include "verify/checks/checks.hpp"
#include "verify/file/relations.hpp"
#include "verify/file/tolerance.hpp"
#include "verify/geometry/geometry.hpp"

namespace ridgecraft::verify {

// The figures cut_mm and fold_mm: the knife goes round each tab instead of along its base, which is folded;
// and how much of the folds is so flat that pages have no line for it.

namespace {

/// Far enough to have a line: what stands on a face rises from it.
constexpr double foot_angle_deg = -90.0;

/// How far the base of a tab is folded when its seam is closed, degrees; 0 where the file doesn't tell.
double angle_at_base(const Case& given, const Tab& tab) {
  if (tab.foot) {
    return foot_angle_deg;
  }
  const Index side = model_side_of(given.file, given.relations, tab.edge);
  return side != none && given.file.model.twin[side] != none
             ? model_fold(given.file, given.relations, side).angle_deg
             : 0.0;
}

// The figure narrow_pieces: what no knife cuts out, though it might hang on another piece.

/// The distance of the two parallel lines between which these corners of a convex polygon lie, at its least.
double width_of(const std::vector<Vec2>& hull) {
  double least = hull.size() < 3 ? 0.0 : HUGE_VAL;
  for (std::size_t i = 0; i < hull.size() && hull.size() >= 3; ++i) {
    const Vec2 along = hull[(i + 1) % hull.size()] - hull[i];
    double most = 0.0;
    for (const Vec2 p : hull) {
      most = std::max(most, cross(along, p - hull[i]));
    }
    least = std::min(least, most / length(along));
  }
  return least;
}

// The figure thin_necks: pieces that would tear in the hand, because two stretches of them hang together by a
// thread of paper. A neck is looked for as the shortest way across the paper from a corner of the outline to
// a side of it: wherever paper is narrow, one end of its narrowest place is a corner.

/// A closed line of cut edges round the paper, or round a hole in it.
struct Loop {
  std::vector<Index> sides;
  std::vector<double> doubled_area;  ///< between a point and the sides before each, and one more for all
};

/// Where a side is among the loops.
struct Place {
  Index loop = none;
  Index at = 0;
};

/// From a corner of the outline straight across the paper.
struct Chord {
  Vec2 from, to;
};

/// Seen from the origin, does a direction point between two others, counterclockwise from the first?
bool points_between(Vec2 direction, Vec2 first, Vec2 second) {
  const bool after = cross(first, direction) > 0.0;
  const bool before = cross(direction, second) > 0.0;
  return cross(first, second) > 0.0 ? after && before : after || before;
}

/// Do two segments cross in points that are no ends?
bool cross_inside(const Chord& a, const Chord& b) {
  const auto apart = [](const Chord& line, const Chord& ends) {
    const Vec2 along = line.to - line.from;
    return cross(along, ends.from - line.from) * cross(along, ends.to - line.from) < 0.0;
  };
  return apart(a, b) && apart(b, a);
}

class Necks {
 public:
  explicit Necks(const Case& given)
      : file_(given.file),
        relations_(given.relations),
        context_(given.context),
        place_(file_.faces.sides()),
        thin_(file_.pieces.size(), 0) {
    find_loops();
  }

  [[nodiscard]] std::size_t thin_pieces() {
    std::vector<Index> sides;
    std::vector<Box2> boxes;
    for (const Loop& loop : loops_) {
      for (const Index side : loop.sides) {
        sides.push_back(side);
        boxes.push_back(around(tail(side), head(side)));
      }
    }
    const BoxFinder finder(boxes);
    std::vector<Index> near;
    for (std::size_t i = 0; i < sides.size(); ++i) {
      if (i % 1024 == 0) {
        context_.check();
      }
      if (thin_[piece_of(sides[i])] != 0) {
        continue;
      }
      near.clear();
      finder.for_each_overlapping(around(tail(sides[i]), tail(sides[i])), [&](std::uint32_t k) {
        if (piece_of(sides[k]) == piece_of(sides[i])) {
          near.push_back(sides[k]);
        }
      });
      thin_[piece_of(sides[i])] = begins_neck(sides[i], near) ? 1 : 0;
    }
    return static_cast<std::size_t>(std::count(thin_.begin(), thin_.end(), 1));
  }

 private:
  [[nodiscard]] Vec2 tail(Index side) const { return file_.points[file_.faces.tail(side)]; }
  [[nodiscard]] Vec2 head(Index side) const { return file_.points[file_.faces.head(side)]; }
  [[nodiscard]] Index piece_of(Index side) const { return file_.face_piece[file_.faces.face(side)]; }

  /// All that may be a neck away from a segment.
  [[nodiscard]] static Box2 around(Vec2 a, Vec2 b) {
    return grown(box_of(std::array{a, b}), 0.5 * least_neck_mm);
  }

  void find_loops() {
    for (Index first = 0; first < file_.faces.sides(); ++first) {
      if (relations_.fold_twin[first] != none || place_[first].loop != none) {
        continue;
      }
      Loop loop;
      loop.doubled_area.push_back(0.0);
      const Vec2 origin = tail(first);
      Index side = first;
      do {
        place_[side] = {static_cast<Index>(loops_.size()), static_cast<Index>(loop.sides.size())};
        loop.sides.push_back(side);
        loop.doubled_area.push_back(loop.doubled_area.back() +
                                    cross(tail(side) - origin, head(side) - origin));
        side = file_.faces.next(side);
        while (relations_.fold_twin[side] != none) {
          side = file_.faces.next(relations_.fold_twin[side]);
        }
      } while (side != first);
      loops_.push_back(std::move(loop));
    }
  }

  /// The side of the outline that ends where this one begins.
  [[nodiscard]] Index before(Index side) const {
    const Loop& loop = loops_[place_[side].loop];
    const Index at = place_[side].at;
    return loop.sides[at > 0 ? at - 1 : loop.sides.size() - 1];
  }

  /// Does a direction lead into the paper, where a side of the outline begins?
  [[nodiscard]] bool leads_inside(Index side, Vec2 direction) const {
    return points_between(direction, head(side) - tail(side), tail(before(side)) - tail(side));
  }

  /// Is there a short way from the corner where a side begins across the paper, with much of it on either
  /// hand?
  [[nodiscard]] bool begins_neck(Index side, const std::vector<Index>& near) const {
    return std::any_of(near.begin(), near.end(), [&](Index other) {
      const std::optional<Chord> chord = way_across(side, other);
      return chord && parts_much(side, other, *chord) && std::none_of(near.begin(), near.end(), [&](Index k) {
               return cross_inside(*chord, {tail(k), head(k)});
             });
    });
  }

  [[nodiscard]] std::optional<Chord> way_across(Index side, Index other) const {
    if (other == side || other == before(side) || place_[other].loop != place_[side].loop) {
      return std::nullopt;
    }
    const Vec2 from = tail(side);
    const Chord chord{from, nearest_on_segment(from, tail(other), head(other))};
    const Vec2 back = from - chord.to;
    const double wide = length(back);
    if (!(wide > same_point_mm && wide < least_neck_mm) || !leads_inside(side, -1.0 * back)) {
      return std::nullopt;
    }
    if (chord.to == tail(other)) {
      return leads_inside(other, back) ? std::optional(chord) : std::nullopt;
    }
    // The end of a side is the beginning of the next one, which is looked at as well.
    const bool lands = chord.to != head(other) && cross(head(other) - tail(other), back) > 0.0;
    return lands ? std::optional(chord) : std::nullopt;
  }

  /// Is there enough paper on both hands of a way from where a side begins to another one?
  [[nodiscard]] bool parts_much(Index side, Index other, const Chord& chord) const {
    const Loop& loop = loops_[place_[side].loop];
    const Vec2 origin = tail(loop.sides.front());
    const double all = loop.doubled_area.back();
    const Index at = place_[side].at;
    const Index until = place_[other].at;
    double doubled = loop.doubled_area[until] - loop.doubled_area[at] + (until < at ? all : 0.0);
    doubled += cross(tail(other) - origin, chord.to - origin) + cross(chord.to - origin, chord.from - origin);
    return std::min(doubled, all - doubled) > 2.0 * held_by_neck_mm2;
  }

  const File& file_;
  const Relations& relations_;
  const Context& context_;
  std::vector<Place> place_;  ///< per side
  std::vector<char> thin_;    ///< per piece
  std::vector<Loop> loops_;
};

}  // namespace

void measure_cuts(const Case& given, Findings& findings) {
  const File& file = given.file;
  double& cut = findings.figures().cut_mm;
  double& fold = findings.figures().fold_mm;
  double& unlined = findings.figures().unlined_fold_mm;
  const double hidden_deg = file.settings.number("hide_folds_deg").value_or(default_hidden_deg);
  for (const Edge& edge : file.edges) {
    const double size = length(file.points[edge.ends[1]] - file.points[edge.ends[0]]);
    if (edge.assignment == Assignment::cut) {
      cut += size;
    } else if (edge.assignment != Assignment::flat) {
      fold += size;
      unlined += std::abs(edge.angle_deg) < hidden_deg ? size : 0.0;
    }
  }
  for (const Tab& tab : file.tabs) {
    const double base = length(tab.polygon[1] - tab.polygon[0]);
    fold += base;
    unlined += std::abs(angle_at_base(given, tab)) < hidden_deg ? base : 0.0;
    cut -= base;
    cut += tab.slit ? length((*tab.slit)[1] - (*tab.slit)[0]) : 0.0;
    for (std::size_t k = 1; k < tab.polygon.size(); ++k) {
      cut += length(tab.polygon[(k + 1) % tab.polygon.size()] - tab.polygon[k]);
    }
  }
}

void count_narrow_pieces(const Case& given, Findings& findings) {
  const File& file = given.file;
  std::vector<std::vector<Vec2>> corners(file.pieces.size());
  for (Index face = 0; face < file.faces.faces(); ++face) {
    for (const Vec2 p : file.polygon(face)) {
      corners[file.face_piece[face]].push_back(p);
    }
  }
  std::vector<char> meets_another(file.pieces.size(), 0);
  for (const Join& join : file.joins) {
    const Index first = piece_of_edge(file, given.relations, join.edges[0]);
    const Index second = piece_of_edge(file, given.relations, join.edges[1]);
    if (first != second) {
      meets_another[first] = meets_another[second] = 1;
    }
  }
  for (Index piece = 0; piece < file.pieces.size(); ++piece) {
    const bool narrow =
        meets_another[piece] != 0 && width_of(convex_hull(std::move(corners[piece]))) < least_piece_mm;
    findings.figures().narrow_pieces += narrow ? 1 : 0;
  }
}

void count_thin_necks(const Case& given, Findings& findings) {
  findings.figures().thin_necks = Necks(given).thin_pieces();
}

}  // namespace ridgecraft::verify
