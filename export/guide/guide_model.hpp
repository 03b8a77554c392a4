// SPDX-License-Identifier: GPL-3.0-or-later
// What every page of the guide is drawn from and on: the model with its pieces, and the sheet.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "export/assembly/assembly.hpp"
#include "export/guide/effort.hpp"
#include "export/guide/picture.hpp"
#include "export/page/piece_drawing.hpp"
#include "export/sheet/bodies.hpp"
#include "export/sheet/drawing.hpp"
#include "export/sheet/pages.hpp"
#include "export/sheet/paper.hpp"

namespace ridgecraft::export_ {

/// Upright, in millimetres: A4, or letter where the nets are on a size of paper made of inches. The guide is
/// read, not cut, so it needn't have the size of the nets.
struct GuideSheet {
  Vec2 size{210.0, 297.0};
  double margin = 14.0;
  double foot = 10.0;  ///< of the printable height, for the page's number

  /// What the pages' contents have.
  [[nodiscard]] Box2 room() const { return {{margin, margin + foot}, {size.x - margin, size.y - margin}}; }
};
[[nodiscard]] GuideSheet guide_sheet(const Paper& nets);

inline constexpr Color guide_grey{0x70, 0x70, 0x70};

/// A line over the page's width or a part of it.
[[nodiscard]] Line guide_rule(Vec2 from, Vec2 to);
/// Texts in grey.
[[nodiscard]] Text in_grey(Text text);

/// The foot of a page: the model's name, and which page it is.
[[nodiscard]] Group guide_foot(const GuideSheet& sheet, const std::string& title, std::size_t page,
                               std::size_t count);

/// Not copied: all that it points to must outlive it.
struct GuideModel {
  const prepare::Prepared* model = nullptr;
  const unfold::Nets* nets = nullptr;
  const Pages* pages = nullptr;
  const Assembly* assembly = nullptr;
  std::span<const Body> bodies;
  std::size_t sheets = 0;  ///< to be printed, lists of numbers included
  double hidden_fold_angle = 0.0;
  bool in_colour = false;  ///< the finished model is shown in its own colours
  std::string title;
  GuideSheet sheet;
  Stance stance;  ///< as the model stands: its width, depth and height
  Stance shown;   ///< the same turned to the side that the first page shows
  Effort effort;
  Scene scene;                         ///< all pieces
  IdVector<PieceId, PieceLook> looks;  ///< in their hues
  PieceLook pale;
  IdVector<PieceId, PieceContents> contents;
  IdVector<FaceId, std::uint32_t> piece_of_face;

  [[nodiscard]] const mesh::Surface& surface() const { return model->model.surface; }
};

/// A side that the model is looked at from, a little from above or below.
struct Viewpoint {
  double azimuth = 0.0;    ///< radians
  double elevation = 0.0;  ///< radians
  std::string_view words;
};
/// Seen from GuideModel::shown: four sides from above, one after the other round the model, then the same
/// from below. Their words don't say what is its front: files don't, either.
[[nodiscard]] const std::array<Viewpoint, 8>& guide_sides();

/// Adds the piece with its tabs and folds to the group, as large as the frame allows, at its upper border.
/// Where it lies. O(faces of the piece).
Box2 add_net_picture(const GuideModel& guide, PieceId piece, const Box2& frame, Group& group);

}  // namespace ridgecraft::export_
