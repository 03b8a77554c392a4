// SPDX-License-Identifier: GPL-3.0-or-later
// The second page of the guide: where each piece is on the model.
#pragma once

#include "base/context.hpp"
#include "export/guide/guide_model.hpp"

namespace ridgecraft::export_ {

/// The model from four sides, and from two below where pieces are hardly seen otherwise or there is room,
/// each piece in its hue and named where it is seen best at least. In as many columns as make it largest.
/// Throws Error(interrupted). O(8 coarse views + 4 to 6 views).
[[nodiscard]] Group overview(const GuideModel& guide, const Context& context);

}  // namespace ridgecraft::export_
