// SPDX-License-Identifier: GPL-3.0-or-later
// A small picture of a net, as it lies on its sheet.
#pragma once

#include "export/sheet/drawing.hpp"
#include "export/sheet/pages.hpp"
#include "mesh/model/surface.hpp"
#include "unfold/net/nets.hpp"

namespace ridgecraft::paper {

/// Adds the piece with its tabs and folds to the group, as large as the frame allows. O(faces of the piece).
void add_net_picture(const mesh::Surface& surface, const unfold::Nets& nets, PieceId piece,
                     const Placement& placement, double hidden_fold_angle, Color hue, const Box2& frame,
                     Group& group);

}  // namespace ridgecraft::paper
