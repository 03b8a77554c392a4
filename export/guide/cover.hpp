// SPDX-License-Identifier: GPL-3.0-or-later
// The first pages of the guide: the finished model with what there is to know before one begins, and where
// each piece is on it.
#pragma once

#include "export/guide/guide_model.hpp"

namespace ridgecraft::paper {

[[nodiscard]] Group cover(const GuideModel& guide);

/// The model from four sides, and from below where only that shows some piece, each piece in its hue and
/// named where it is seen best at least. O(8 coarse views + 4 to 6 views).
[[nodiscard]] Group overview(const GuideModel& guide);

}  // namespace ridgecraft::paper
