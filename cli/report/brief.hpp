// SPDX-License-Identifier: GPL-3.0-or-later
// What a maker reads first of a model that became paper, in five lines: how large, how much paper, what was
// done to the model, what will be hard, what to do next.
#pragma once

#include <string>

#include "base/vector.hpp"
#include "cli/arguments/options.hpp"
#include "cli/jobs/make_job.hpp"
#include "cli/report/figures.hpp"

namespace ridgecraft::cli {

/// The size at which these pieces would take a page less (job::Result::share_saving_a_page), whole mm.
[[nodiscard]] double size_saving_a_page(const job::Result& made);

/// "--size 150mm", or the size that was chosen and why: "--size 380mm: at 150 mm folds or faces would be too
/// small".
[[nodiscard]] std::string size_words(const job::Result& made, const std::string& asked);

void add_brief(Summary& summary, const MakeJob& job, const MakeResult& result);

/// Pieces with slivers (prepare::is_sliver).
[[nodiscard]] std::vector<PieceId> pieces_with_slivers(const job::Result& made);

/// That simplification moved a model with these bounds (mm) so far that it is seen
/// (prepare/prepared/prepared.hpp); empty where it isn't.
[[nodiscard]] std::string where_it_differs(double moved_mm, const Box3& bounds);

/// "a thin wall of up to 1.2 mm became a sheet".
[[nodiscard]] std::string thin_walls_text(const prepare::ThinWallReport& sheets);

/// "17 small bodies and 4 flat bodies that lie on others".
[[nodiscard]] std::string details_text(const prepare::Details& details);

}  // namespace ridgecraft::cli
