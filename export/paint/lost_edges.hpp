// SPDX-License-Identifier: GPL-3.0-or-later
// What geometry loses, print keeps: sharp edges of the model as it was read that its paper has no fold for,
// as thin lines on the paper's faces.
#pragma once

#include <vector>

#include "base/context.hpp"
#include "export/page/piece_drawing.hpp"
#include "mesh/look/relief.hpp"
#include "prepare/prepared/prepared.hpp"

namespace ridgecraft::export_ {

/// The creases of `relief` that lie on the model's faces within `reach_mm`, on the side that is seen, along
/// the normals of the faces, without those along its folds and borders; the least folds that are drawn are
/// `hidden_fold_angle` (radians). No two run side by side nearer than 1 mm, and none is a speck of less than
/// 2 mm. Ascending by face. O(creases near faces x length in mm x log n). Throws Error(interrupted).
[[nodiscard]] std::vector<mesh::FaceLine> find_lost_edges(const prepare::Prepared& model,
                                                          const mesh::Relief& relief, double reach_mm,
                                                          double hidden_fold_angle, const Context& context);

/// Adds the lines of Prepared::lost_edges on the piece's faces to its drawing, below all else, with room for
/// its texts. O(lines of the piece x texts).
void add_lost_edges(const PieceOnPage& at, PieceDrawing& piece);

}  // namespace ridgecraft::export_
