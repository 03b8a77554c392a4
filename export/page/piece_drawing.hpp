// SPDX-License-Identifier: GPL-3.0-or-later
// One piece at its place on the page: outlines, folds, tabs, and what its numbers have to stand at.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "export/page/lines.hpp"
#include "export/sheet/drawing.hpp"
#include "export/sheet/pages.hpp"

namespace ridgecraft::export_ {

/// Where a seam's number stands.
enum class NumberAt : std::uint8_t {
  edge,     ///< at the edge or on its tab
  closing,  ///< nowhere: its other edge lies beside it when the paper closes
  list,     ///< in a list of the page or at the end; nowhere on paper too small for lists
};

/// A cut edge of a piece that is glued to another edge.
struct Seam {
  std::uint32_t number = 0;  ///< of its chain
  JoinId join;               ///< of its own
  std::string partner;       ///< name of the piece that the other edge is on; empty where it is this one
  Segment2 edge;             ///< its face lies on the left
  std::vector<Vec2> tab;     ///< the tab that grows from it, first two corners on the edge; or nothing
  NumberAt at = NumberAt::list;
};

/// Where a piece that no join connects with this one is glued on.
struct GlueMark {
  std::string name;                         ///< of the other piece
  std::vector<std::vector<Vec2>> outlines;  ///< on the page; holes among them
  bool named = false;                       ///< its name stands there
};

/// What of a piece is rolled.
struct RollMark {
  /// A point of a bend, where words may stand across it.
  struct Site {
    Vec2 at;
    Vec2 bend;  ///< along it
  };
  std::string words;
  std::vector<Site> sites;  ///< the best first
};

struct PieceDrawing {
  Group group;
  std::string name;
  std::vector<std::string> notes;  ///< small words below the name: what the piece is a part of
  std::vector<Seam> seams;
  /// Of each chain the seams, by their place in `seams`, as they follow each other: each begins where the one
  /// before ends. A piece that is glued to itself has both sides of a chain.
  std::vector<std::vector<std::size_t>> sides;
  /// Of each outline the seams, by their place in `seams`, as they follow each other clockwise on the printed
  /// side; borders are left out.
  std::vector<std::vector<std::size_t>> rims;
  std::vector<std::array<Vec2, 3>> faces;
  std::vector<GlueMark> spots;
  std::vector<RollMark> rolls;
};

/// Whether a point lies in a triangle, whose corners run counterclockwise, or on its border.
[[nodiscard]] bool contains(const std::array<Vec2, 3>& triangle, Vec2 p);
/// Whether a point lies on a face of the piece. O(faces).
[[nodiscard]] bool lies_on(const PieceDrawing& piece, Vec2 p);

/// What lies on a piece; tabs and joins ascending.
struct PieceContents {
  std::vector<TabId> tabs;
  std::vector<JoinId> joins;
  std::vector<std::vector<CornerId>> sides;  ///< of chains, by their numbers; see PieceDrawing
};

/// Of all pieces at once: linear.
[[nodiscard]] IdVector<PieceId, PieceContents> piece_contents(const mesh::Surface& surface,
                                                              const unfold::Nets& nets);

/// A piece at its place. Not copied: all that it names must outlive it.
struct PieceOnPage {
  const prepare::Prepared& model;
  const unfold::Nets& nets;
  PieceId piece;
  const PieceContents& contents;
  const Placement& placement;

  [[nodiscard]] const mesh::Surface& surface() const { return model.model.surface; }
  [[nodiscard]] Vec2 corner(CornerId c) const {
    return placement(nets.flat[mesh::face_of(c)][c.value() % 3]);
  }
};

/// Everything of a piece but its texts and ticks, in page coordinates. No stretch of line is drawn twice.
[[nodiscard]] PieceDrawing piece_drawing(const PieceOnPage& piece, const Style& style);

}  // namespace ridgecraft::export_
