// SPDX-License-Identifier: GPL-3.0-or-later
// Pages: where each piece lies, how it is drawn, and what was drawn.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "base/geometry.hpp"
#include "base/id.hpp"
#include "base/vector.hpp"
#include "export/sheet/bodies.hpp"
#include "export/sheet/paper.hpp"
#include "export/sheet/pieces.hpp"
#include "mesh/model/surface.hpp"
#include "prepare/prepared/options.hpp"
#include "unfold/net/nets.hpp"

namespace ridgecraft::export_ {

/// Where a piece lies: its motion takes its plane to the page (origin: lower left corner of the sheet, y up).
struct Placement : Rigid {
  PageId page;
};

/// Where each piece lies.
struct Pages {
  Paper paper;
  std::size_t count = 0;
  IdVector<PieceId, Placement> placements;
  std::vector<std::string> names;  ///< of each page: what its pieces have in common; or empty
};

/// How much of a model's colours is printed.
enum class Ink {
  colour,  ///< as they are
  pale,    ///< as light tints, which save ink and leave lines and numbers in the foreground
  lines,   ///< nothing but lines
};

/// How much of the shape that the model had before it was simplified is printed.
enum class Details {
  automatic,  ///< as lines, but for models with pictures, which show them
  lines,      ///< thin grey lines
  shade,      ///< what lies in hollows of the model is darker
  none,
};

/// Where the numbers of edges stand.
enum class Numbers {
  inside,   ///< on the piece, at its edges, and on tabs
  tabs,     ///< on tabs; beside the piece at edges without one
  outside,  ///< beside the piece, where they are cut away
  back,     ///< on the back of the piece, at its edges, and on tabs
};

/// Over which edge a printer turns a sheet to print its back.
enum class TurnedOver { long_edge, short_edge };

/// How pages look, as far as users have a say.
struct Style {
  double hidden_fold_angle = prepare::hidden_fold_angle;  ///< smaller folds get no line, radians
  double label_height = 2.5;                              ///< mm
  double smallest_label_height = 1.6;                     ///< mm
  bool tab_shadows = false;                               ///< where tabs come to lie behind faces
  Numbers numbers = Numbers::inside;
  TurnedOver turned_over = TurnedOver::long_edge;  ///< sheets with numbers on their backs
  Ink ink = Ink::colour;
  Details details = Details::automatic;
  double dots_per_inch = 300.0;  ///< of pictures; areas of one colour have no dots
};

/// Pictures of pieces, for drawing again (export/paint/paint.hpp).
class DrawnPictures;

/// What is drawn, beside the pages themselves.
struct DrawReport {
  /// The number of a join, on a piece that has it at one of its edges.
  struct Number {
    std::string piece;
    std::uint32_t number = 0;
    friend auto operator<=>(const Number&, const Number&) = default;
  };
  /// Numbers that found no place on or beside their pieces even at the smallest height, and stand in a list,
  /// on the page or at the end; page by page.
  std::vector<Number> labels_listed;
  std::vector<Number> labels_left_out;  ///< the same where the paper is too small for a list
  /// Of lines to cut, and of lines to fold, bases of tabs among them, as they are drawn, mm: none twice, and
  /// no folds that get no line.
  double cut_mm = 0.0;
  double fold_mm = 0.0;
  std::size_t list_pages = 0;              ///< pages at the end that have such and no pieces
  std::size_t labels_outside = 0;          ///< numbers that stand beside their piece, with a leader
  std::size_t names_left_out = 0;          ///< pieces whose name found no place
  std::vector<GlueOutline> glue_outlines;  ///< where pieces of separate bodies are glued to each other
  std::vector<std::array<PieceId, 2>>
      not_glued;                           ///< those that aren't, if they lie on each other; given, too
  std::vector<Body> bodies;                ///< separate ones, if there are several (export/sheet/bodies.hpp)
  std::vector<PieceKind> kinds;            ///< of pieces that there are several of, as Nets::equal
  IdVector<PieceId, std::string> objects;  ///< of each piece, as find_piece_objects()
  std::shared_ptr<const DrawnPictures> pictures;  ///< for drawing again; none of a model without colours
};

/// Of each piece the direction that its folds have most in common, on its net: the axis of the mean of their
/// doubled angles, each by its length times its fold angle. A unit vector, of either sense; zero where no
/// direction is before others. O(edges).
[[nodiscard]] IdVector<PieceId, Vec2> fold_directions(const mesh::Surface& surface, const unfold::Nets& nets);

/// Pieces whose folds don't run along the grain of their sheet, within 15 degrees: those that fit it no other
/// way. None where the paper has no grain. O(pieces).
[[nodiscard]] std::vector<PieceId> pieces_off_grain(const IdVector<PieceId, Vec2>& directions,
                                                    const Pages& pages);

/// What decides where pieces may lie, beside their shapes; nothing is said of any where a list is empty.
struct LayoutRules {
  IdVector<PieceId, std::uint32_t> sort = {};    ///< those of different sorts never share a page
  IdVector<PieceId, Vec2> fold_directions = {};  ///< as fold_directions(): kept where paper has a grain
};

/// Whether pieces are to lie with their folds along the paper's grain.
[[nodiscard]] inline bool follows_grain(const Paper& paper, const IdVector<PieceId, Vec2>& fold_directions) {
  return paper.grain != Grain::any && !fold_directions.empty();
}

/// How far from the grain's direction folds may run, degrees: it still bends them, and the packer has a
/// choice.
inline constexpr double grain_tolerance_degrees = 15.0;
/// Which way the grain runs on a sheet. A unit vector.
[[nodiscard]] Vec2 grain_direction(const Paper& paper);

}  // namespace ridgecraft::export_
