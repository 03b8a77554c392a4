// SPDX-License-Identifier: GPL-3.0-or-later
// The figure thin_necks: pieces that would tear in the hand, because two stretches of them hang together by a
// thread of paper. A neck is looked for as the shortest way across the paper from a corner of the outline to
// a side of it: wherever paper is narrow, one end of its narrowest place is a corner.
#include <algorithm>
#include <optional>
#include <vector>

#include "base/segment.hpp"
#include "verify/checks/checks.hpp"
#include "verify/file/tolerance.hpp"
#include "verify/geometry/box_finder.hpp"

namespace ridgecraft::verify {
namespace {

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
    const Vec2 reach{0.5 * least_neck_mm, 0.5 * least_neck_mm};
    return {Vec2{std::min(a.x, b.x), std::min(a.y, b.y)} - reach,
            Vec2{std::max(a.x, b.x), std::max(a.y, b.y)} + reach};
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

void count_thin_necks(const Case& given, Findings& findings) {
  findings.figures().thin_necks = Necks(given).thin_pieces();
}

}  // namespace ridgecraft::verify
