// SPDX-License-Identifier: GPL-3.0-or-later
// Which side of the model the guide's first page shows.
#pragma once

#include "export/guide/guide_model.hpp"

namespace ridgecraft::paper {

/// guide.stance, turned by quarters to the side of a model in colours on which most is to be seen: where the
/// colours of neighbouring places differ most in sum, which is where eyes, windows and writing are. The
/// file's own front is kept unless another side has clearly more, and for models without colours. O(dots x
/// log of the model's faces).
[[nodiscard]] Stance turned_to_cover(const GuideModel& guide);

}  // namespace ridgecraft::paper
