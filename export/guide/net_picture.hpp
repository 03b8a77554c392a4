// SPDX-License-Identifier: GPL-3.0-or-later
// A small picture of a net, as it lies on its sheet.
#pragma once

#include "export/guide/guide_model.hpp"

namespace ridgecraft::export_ {

/// Adds the piece with its tabs and folds to the group, as large as the frame allows, at its upper border.
/// Where it lies. O(faces of the piece).
Box2 add_net_picture(const GuideModel& guide, PieceId piece, const Box2& frame, Group& group);

}  // namespace ridgecraft::export_
