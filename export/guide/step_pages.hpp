// SPDX-License-Identifier: GPL-3.0-or-later
// The pages with the steps: what is added in each, where, and what is glued.
#pragma once

#include <vector>

#include "base/context.hpp"
#include "export/guide/guide_model.hpp"

namespace ridgecraft::export_ {

/// Six steps a page, twelve or twenty where there are many. What is added is in its hue, what stands already
/// is pale; a small addition is shown larger, with what is round it. The side is that of the step before,
/// unless another one shows much more of what is added. Where there are very many faces and steps, or
/// the context's deadline has passed, a picture has what is added and what that is glued to alone. Throws
/// Error(interrupted).
[[nodiscard]] std::vector<Group> step_pages(const GuideModel& guide, const Context& context);

}  // namespace ridgecraft::export_
