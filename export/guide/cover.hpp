// SPDX-License-Identifier: GPL-3.0-or-later
// The first pages of the guide: the finished model with what there is to know before one begins, and where
// each piece is on it.
#pragma once

#include "base/context.hpp"
#include "export/guide/guide_model.hpp"

namespace ridgecraft::paper {

/// In the model's own colours, where it has some and they are printed; else in the hues of its pieces. Throws
/// Error(interrupted).
[[nodiscard]] Group cover(const GuideModel& guide, const Context& context);

/// The model from four sides, and from below where only that shows some piece, each piece in its hue and
/// named where it is seen best at least. Throws Error(interrupted). O(8 coarse views + 4 to 6 views).
[[nodiscard]] Group overview(const GuideModel& guide, const Context& context);

}  // namespace ridgecraft::paper
