// SPDX-License-Identifier: GPL-3.0-or-later
// Places for numbers: on tabs, at edges, further inside, at the end of leaders; and which edges need none.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "export/page/obstacles.hpp"
#include "export/page/piece_drawing.hpp"
#include "export/sheet/pages.hpp"

namespace ridgecraft::export_ {

/// An edge of a piece.
struct EdgeOfPiece {
  PieceDrawing* piece = nullptr;
  const Seam* seam = nullptr;
};

/// A number on the piece that still needs a place.
struct Wanted {
  PieceDrawing* piece = nullptr;
  std::size_t side = 0;            ///< of PieceDrawing::sides
  std::vector<const Seam*> seams;  ///< it may stand at any of them, at the first rather than the last
};

/// Where a number may stand, beside on its tab.
enum class NumberPlace : std::uint8_t {
  at_edge,         ///< inside the piece, along the edge, close to it, else across it
  further_inside,  ///< likewise, further inside the same panel
  beside_piece,    ///< as at_edge, outside the piece: beyond the tab, if there is one
  leader_inside,   ///< anywhere around the edge, with a line to it
  leader_outside,  ///< likewise, outside the piece; such numbers are lost when it is cut out
};

/// Each attempt adds the text, and its leader, to the piece's group where it finds a place, and says whether
/// it did. No text covers a line or another text, or reaches out of the area. Heights of letters go from
/// Style::label_height down to Style::smallest_label_height. O(places tried x lines near them).
class NumberPlacer {
 public:
  NumberPlacer(Vec2 page_size, const Box2& area, const Style& style);

  [[nodiscard]] Obstacles& obstacles() { return obstacles_; }
  /// All lines of the piece are in the way from now on.
  void add_lines(const PieceDrawing& piece);

  bool place_on_tab(PieceDrawing& piece, const Seam& seam);
  /// At the first of its edges that has room there.
  bool place(const Wanted& wanted, NumberPlace where);
  /// Numbers tell on which piece the other edge is ("B:12"), where there is room for it.
  void name_partners();

 private:
  enum class Side { inside, outside };
  struct Frame;
  /// A number that stands by its edge or on its tab.
  struct Placed {
    PieceDrawing* piece = nullptr;
    const Seam* seam = nullptr;
    std::size_t text = 0;  ///< of the piece's texts
    std::uint32_t obstacle = 0;
    bool on_tab = false;
  };

  bool place_at(const EdgeOfPiece& at, NumberPlace where);
  [[nodiscard]] std::optional<Text> with_partner(const Text& plain, const Placed& placed) const;
  bool put(PieceDrawing& piece, const Text& text, const TurnedBox& box);
  bool place_near(const EdgeOfPiece& at, Side side);
  bool place_further_inside(const EdgeOfPiece& at);
  bool place_with_leader(const EdgeOfPiece& at, Side side);
  bool place_along(const EdgeOfPiece& at, double height, double offset, bool across, Side side);
  /// `text` wherever around a point of its edge there is room for it.
  bool lead_from(const EdgeOfPiece& at, Text text, Vec2 start, const Frame& frame, Side side);
  bool put_with_leader(const EdgeOfPiece& at, const Text& text, const TurnedBox& box, const Segment2& leader,
                       Vec2 out);

  Obstacles obstacles_;
  Box2 area_;
  std::vector<double> heights_;
  std::vector<Placed> placed_;
  std::uint32_t last_text_ = 0;  ///< number of the obstacle that was added last
};

/// Whether a number can be read as another one upside down: 6 and 9, 68 and 89, 16 and 91.
[[nodiscard]] bool ambiguous_upside_down(std::string_view number);

/// Whether this number can be left out once the other edge with it has it: on the same outline, no border
/// between them, and nothing else than pairs of edges that close in the same way, as a zip does from its end.
/// `at`: a place in `rim`, which is one of the piece's. O(the rim).
[[nodiscard]] bool closes_by_itself(const PieceDrawing& piece, const std::vector<std::size_t>& rim,
                                    std::size_t at);

/// Of the numbers that have no place, those that need none (NumberAt::closing): their other edge has it and
/// closes_by_itself(). O(square of a rim).
void leave_out_closing(PieceDrawing& piece);

}  // namespace ridgecraft::export_
