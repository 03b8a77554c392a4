// SPDX-License-Identifier: GPL-3.0-or-later
// The model's colours on pages, as areas and as pictures.
#pragma once

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "base/context.hpp"
#include "export/page/piece_drawing.hpp"
#include "export/paint/cells.hpp"
#include "export/paint/face_colours.hpp"
#include "export/sheet/drawing.hpp"
#include "export/sheet/pages.hpp"
#include "mesh/look/look.hpp"
#include "prepare/prepared/prepared.hpp"
#include "unfold/net/nets.hpp"

namespace ridgecraft::export_ {

// Pictures that were drawn on pages, to be taken again where a piece is drawn as it was: after an edit most
// are, and to find their colours and to paint them takes most of its time.

/// Those of all pieces of one drawing. Each is found by the cells that it was painted of.
class DrawnPictures {
 public:
  /// A picture and what it was painted of.
  struct OfPiece {
    std::vector<Cell> cells;
    Image image;
  };

  using Colours = std::shared_ptr<const IdVector<FaceId, FaceColours>>;

  DrawnPictures(std::shared_ptr<const mesh::Look> look, Colours colours, const Style& style)
      : look_(std::move(look)),
        colours_(std::move(colours)),
        ink_(style.ink),
        dots_per_inch_(style.dots_per_inch) {}

  /// The colours of all faces, as face_colours() finds them; never null.
  [[nodiscard]] const Colours& colours() const { return colours_; }

  /// Whether pictures of this look in this style would be painted like these.
  [[nodiscard]] bool fit(const std::shared_ptr<const mesh::Look>& look, const Style& style) const {
    return look_ == look && ink_ == style.ink && dots_per_inch_ == style.dots_per_inch;
  }

  void add(OfPiece picture) { all_.push_back(std::move(picture)); }

  /// The one that was painted of such cells; none where none was. O(pictures) and once the cells.
  [[nodiscard]] const Image* find(const std::vector<Cell>& cells) const {
    const auto found = std::find_if(all_.begin(), all_.end(), [&](const OfPiece& picture) {
      return std::equal(picture.cells.begin(), picture.cells.end(), cells.begin(), cells.end(), alike);
    });
    return found == all_.end() ? nullptr : &found->image;
  }

 private:
  static bool alike(const Cell& a, const Cell& b) {
    return a.kind == b.kind && a.face == b.face && a.at == b.at && a.polygon == b.polygon;
  }

  std::shared_ptr<const mesh::Look> look_;
  Colours colours_;
  Ink ink_;
  double dots_per_inch_;
  std::vector<OfPiece> all_;
};

/// What is painted. Not copied: all that it names must outlive it.
struct PaintTask {
  const prepare::Prepared& model;
  const unfold::Nets& nets;
  const IdVector<PieceId, PieceContents>& contents;
  const Pages& layout;
  const Style& style;
  const std::vector<std::vector<PieceId>>& ids;  ///< of the pieces of each page
};

/// Adds colours to the pieces of all pages, `pages[i]` being those of page i with their texts: areas where a
/// face has one colour, a picture a piece where it hasn't; a rim beyond cut edges, a strip on each tab. Gives
/// lines and texts a tone that can be seen on them. Nothing where the model has no look, or Style wants lines
/// alone. Pictures are taken from those of an earlier drawing of the same surface, if there are any, where
/// nothing of them changes. Returns those of this one; none where there are none. Independent of the number
/// of threads, and of what was drawn before. Throws Error(interrupted).
std::shared_ptr<const DrawnPictures> paint_pieces(const PaintTask& task,
                                                  std::vector<std::vector<PieceDrawing>>& pages,
                                                  const DrawnPictures* before, const Context& context);

}  // namespace ridgecraft::export_
