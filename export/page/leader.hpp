// SPDX-License-Identifier: GPL-3.0-or-later
// Leaders: thin lines from a number or a name to its edge. Nobody may take them for folds or for a slip of
// the knife.
#pragma once

#include "export/page/obstacles.hpp"
#include "export/page/piece_drawing.hpp"
#include "export/page/segment2.hpp"

namespace ridgecraft::export_ {

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
