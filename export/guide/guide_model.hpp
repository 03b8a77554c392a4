// SPDX-License-Identifier: GPL-3.0-or-later
// What every page of the guide is drawn from.
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "export/assembly/assembly.hpp"
#include "export/guide/effort.hpp"
#include "export/guide/guide_page.hpp"
#include "export/guide/picture.hpp"
#include "export/page/piece_drawing.hpp"
#include "export/sheet/bodies.hpp"
#include "export/sheet/pages.hpp"

namespace ridgecraft::paper {

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
  Stance stance;  ///< as the model stands, which its size is told by
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

}  // namespace ridgecraft::paper
