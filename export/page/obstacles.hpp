// SPDX-License-Identifier: GPL-3.0-or-later
// What a text must keep clear of: lines and other texts of one page, found by place; and leaders, thin lines
// from a text to its edge, which nobody may take for folds or for a slip of the knife.
#pragma once

#include <cstdint>
#include <numbers>
#include <vector>

#include "export/page/lines.hpp"
#include "export/page/piece_drawing.hpp"
#include "export/sheet/drawing.hpp"

namespace ridgecraft::export_ {

/// The angle of a text on the same line that is upright as far as possible: in (-90, 90] degrees; a hair
/// below -90 counts as +90, so that vertical texts of a page all read upwards. Radians.
[[nodiscard]] inline double upright(double angle) {
  constexpr double half = 0.5 * std::numbers::pi;
  constexpr double hair = 1e-3;
  while (angle > half + hair) {
    angle -= std::numbers::pi;
  }
  while (angle < -half + hair) {
    angle += std::numbers::pi;
  }
  return angle;
}

/// A rectangle in any direction.
struct TurnedBox {
  Vec2 centre;
  Vec2 along;  ///< unit vector of its first side
  double half_width = 0.0;
  double half_height = 0.0;

  [[nodiscard]] TurnedBox grown(double by) const {
    return {centre, along, half_width + by, half_height + by};
  }
  [[nodiscard]] Box2 bounds() const;
};

/// The box that a text covers, its underline included, without the pen's width.
[[nodiscard]] TurnedBox box_of(const Text& text);
/// The box that a text of this height keeps for itself among other texts, of the one that it covers: a
/// blank's width before and behind it, so that two numbers in one line are never read as one.
[[nodiscard]] TurnedBox with_spacing(TurnedBox box, double height);
/// The height by which with_spacing() gives a text its room: names and what stands below them are words, with
/// blanks within, so a number in their line keeps more than a blank away.
[[nodiscard]] double spacing_height(const Text& text);
/// Whether two boxes share more than a border.
[[nodiscard]] bool overlap(const TurnedBox& a, const TurnedBox& b);
/// Whether a segment meets a box.
[[nodiscard]] bool meets(const Segment2& segment, const TurnedBox& box);

/// Lines nearer to each other than this, at less than this angle (sine of 20 degrees), run along each other.
inline constexpr double beside_mm = 0.9;
inline constexpr double beside_sine = 0.342;

/// Lines and boxes in a grid of square cells over the page.
class Obstacles {
 public:
  explicit Obstacles(Vec2 page_size);

  /// Lines that may be crossed by a leader (folds) and lines that may not (cuts).
  enum class Kind : std::uint8_t { cut, fold };
  void add(const Segment2& line, Kind kind);
  /// Its number, for replace() and is_free().
  std::uint32_t add(const Text& text);
  /// Another text instead of an earlier one.
  void replace(std::uint32_t number, const Text& text);

  static constexpr std::uint32_t no_text = 0xffffffff;
  /// Whether the text's box, grown by `clearance` and `more`, meets no line and not the page's edge, and its
  /// room, grown by `more`, no other text's room, but that of the text with the number `but`. O(what lies in
  /// its cells).
  [[nodiscard]] bool is_free(const Text& text, double clearance, double more = 0.0,
                             std::uint32_t but = no_text) const {
    return is_free(box_of(text), spacing_height(text), clearance, more, but);
  }
  /// The same of a text of this height whose box is known.
  [[nodiscard]] bool is_free(const TurnedBox& text, double height, double clearance, double more = 0.0,
                             std::uint32_t but = no_text) const;
  /// Whether the line meets no cut and no box; with `folds_too` no fold either.
  [[nodiscard]] bool is_free(const Segment2& line, bool folds_too) const;
  /// Distance of the nearest line from a point, mm, at most `most`.
  [[nodiscard]] double distance_to_lines(Vec2 p, double most) const;
  /// Whether the line runs beside another one, near it and in nearly its direction: then it looks like one of
  /// a pair, or like a fold.
  [[nodiscard]] bool runs_along_another(const Segment2& line) const;

 private:
  struct Stored {
    Segment2 line;
    Kind kind = Kind::cut;
  };
  struct Cell {
    std::vector<std::uint32_t> lines;
    std::vector<std::uint32_t> boxes;
  };
  /// Calls visit(cell) for each cell that the rectangle touches until it returns true; whether one did.
  template <class Visit>
  bool any_cell(const Box2& bounds, Visit visit) const;
  [[nodiscard]] std::vector<std::uint32_t> cells_of(const Box2& bounds) const;

  Vec2 size_;
  std::uint32_t columns_ = 1;
  std::uint32_t rows_ = 1;
  std::vector<Cell> cells_;
  std::vector<Stored> lines_;
  struct Taken {
    TurnedBox box;
    TurnedBox room;
  };
  std::vector<Taken> boxes_;
};

// Leaders: thin lines from a number or a name to its edge. Nobody may take them for folds or for a slip of
// the knife.

/// A leader begins this far beside its edge, so as not to touch it, mm.
inline constexpr double off_the_edge_mm = 0.03;

/// Whether a line from an edge to a text can be a leader: not too short to be seen, leaving its edge at 40
/// degrees or more (`out` is perpendicular to the edge, of length 1), and running along no other line.
[[nodiscard]] inline bool can_lead(const Segment2& leader, Vec2 out, const Obstacles& obstacles) {
  constexpr double shortest_mm = 0.8;
  constexpr double least_sine = 0.643;
  const Vec2 d = leader.b - leader.a;
  return length(d) >= shortest_mm && dot(d, out) >= least_sine * length(d) &&
         !obstacles.runs_along_another(leader);
}

inline void draw_leader(const Segment2& leader, PieceDrawing& piece, Obstacles& obstacles) {
  obstacles.add(leader, Obstacles::Kind::cut);
  piece.group.lines.push_back({Layer::label, {leader.a, leader.b}, false, Fold::none});
}

}  // namespace ridgecraft::export_
