// SPDX-License-Identifier: GPL-3.0-or-later
// What follows from nets: other tabs, assembly, pages, drawings, the guide, the FOLD file and its check.
// Private to job/; what others may change of a finished job stands in job.hpp.
#pragma once

#include "base/context.hpp"
#include "job/result.hpp"
#include "job/stage_clock.hpp"

namespace ridgecraft::job {

/// Other tabs, as the options ask for them.
void give_new_tabs(Result& made, StageClock& clock, const Context& context);

/// The order in which the nets are glued, as the model stands.
[[nodiscard]] export_::Assembly assembly_of(const Result& made);

/// Nets of board where that is asked for, and where all nets lie.
void lay_out_pages(Result& made, StageClock& clock, const Context& context);

/// All drawings of pages that are laid out, and the guide where it is asked for.
void draw_pages(Result& made, StageClock& clock, const Context& context);

/// The guide of nets whose pages are drawn.
[[nodiscard]] export_::Guide drawn_guide(const Result& made, const Context& context);

/// The FOLD file, checked. Glue outlines that fail are left out, and a note of the nets says so. Throws
/// Error(internal) where anything else fails.
void finish(Result& made, StageClock& clock, const Context& context);

}  // namespace ridgecraft::job
