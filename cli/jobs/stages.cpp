// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/jobs/stages.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/option_table.hpp"

namespace ridgecraft::cli {
namespace {

/// Throws Error(usage) when the hierarchy has no such number of parts.
void require_possible(const std::string& model, std::size_t parts, const segment::Hierarchy& hierarchy) {
  if (parts < hierarchy.fewest()) {
    throw Error(ErrorKind::usage, fmt::format("--parts {}: {} has {} components, and parts hang together",
                                              parts, model, hierarchy.fewest()));
  }
  if (parts > hierarchy.leaves) {
    throw Error(ErrorKind::usage,
                fmt::format("--parts {}: {} can be cut along its concave places into {} at most", parts,
                            model, hierarchy.leaves));
  }
}

}  // namespace

segment::Options options_for(const mesh::Model& model, const PartArguments& parts) {
  segment::Options options = parts.options;
  if (parts.concavity_mm) {
    const Option& row = option_row("concavity");
    const double mm = model.file_scale * model.frame.mm_per_unit.value_or(1.0);
    // What is finer or coarser than any model has makes no difference.
    options.concavity =
        std::clamp(*parts.concavity_mm / (mm * segment::scale_of(model.surface)), row.low, row.high);
  }
  return options;
}

segment::Segmentation find_parts(const mesh::Model& model, const std::string& file,
                                 const PartArguments& parts, std::optional<segment::Hierarchy>& hierarchy,
                                 const Context& context) {
  if (parts.count == 0) {
    return segment::segment(model.surface, model.polygon.items(), options_for(model, parts), context);
  }
  if (!hierarchy) {
    hierarchy = segment::find_hierarchy(model.surface, model.polygon.items(), parts.count, context);
  }
  require_possible(file, parts.count, *hierarchy);
  return hierarchy->parts(parts.count);
}

}  // namespace ridgecraft::cli
