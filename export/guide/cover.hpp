// SPDX-License-Identifier: GPL-3.0-or-later
// The first page of the guide: the finished model with what there is to know before one begins.
#pragma once

#include "base/context.hpp"
#include "export/guide/guide_model.hpp"

namespace ridgecraft::paper {

/// In the model's own colours, where it has some and they are printed; else in the hues of its pieces. Throws
/// Error(interrupted).
[[nodiscard]] Group cover(const GuideModel& guide, const Context& context);

}  // namespace ridgecraft::paper
