// SPDX-License-Identifier: GPL-3.0-or-later
// The first page of the guide: the finished model, from the side that shows it best, with what there is to
// know.
#pragma once

#include "base/context.hpp"
#include "export/guide/guide_model.hpp"

namespace ridgecraft::export_ {

/// guide.stance, turned by quarters to the side of a model in colours on which most is to be seen: where the
/// colours of neighbouring places differ most in sum, which is where eyes, windows and writing are. The
/// file's own front is kept unless another side has clearly more, and for models without colours. O(dots x
/// log of the model's faces).
[[nodiscard]] Stance turned_to_cover(const GuideModel& guide);

/// In the model's own colours, where it has some and they are printed; else in the hues of its pieces. Throws
/// Error(interrupted).
[[nodiscard]] Group cover(const GuideModel& guide, const Context& context);

}  // namespace ridgecraft::export_
