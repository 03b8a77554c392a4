// SPDX-License-Identifier: GPL-3.0-or-later
// A part of a piece drawn once more, at one scale, with the numbers and names that have no room on the piece.
#pragma once

#include <cstddef>
#include <vector>

#include "export/page/enlarged_picture.hpp"
#include "export/page/piece_drawing.hpp"
#include "export/sheet/pages.hpp"

namespace ridgecraft::paper {

/// What has no place on the piece and is near each other: numbers and names of what is glued on.
struct Lost {
  std::vector<std::size_t> seams, spots;  ///< their places in the piece
  Box2 box;                               ///< around them and what is seen of their surroundings, on the page
};

class EnlargedPart {
 public:
  /// The part in the middle of which lies what is lost: as large as that is, but no picture is smaller than
  /// `least` or larger than `most`, mm on paper, the latter each way. Keeps references to both. O(lines of
  /// the piece).
  EnlargedPart(const PieceDrawing& piece, const Lost& lost, double scale, double least, Vec2 most);

  /// Places numbers and names; how many of those that are lost find their place.
  std::size_t place(const Style& style);
  /// Whether each of those that have their place in the other picture of them has its place here.
  [[nodiscard]] bool tells_as_much_as(const EnlargedPart& other) const;

  /// Tells those of the piece that have their place here.
  void tell(PieceDrawing& piece) const;
  /// With a frame.
  [[nodiscard]] Enlarged framed() &&;

 private:
  [[nodiscard]] Vec2 on_picture(Vec2 p) const { return scale_ * (p - window_.low); }
  [[nodiscard]] std::size_t placed() const;
  void add_lines();
  void add_areas();
  void add_seams();
  void add_seam(const Seam& seam, const Segment2& seen);

  const PieceDrawing& piece_;
  const Lost& lost_;
  double scale_;
  Box2 window_;  ///< on the page
  PieceDrawing part_;
};

}  // namespace ridgecraft::paper
