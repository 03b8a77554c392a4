// SPDX-License-Identifier: GPL-3.0-or-later
// The parts that the options ask for.
#pragma once

#include <optional>
#include <string>

#include "cli/arguments/options.hpp"
#include "mesh/model/model.hpp"
#include "segment/hierarchy.hpp"
#include "segment/segment.hpp"

namespace ridgecraft::cli {

/// `file` is what messages call the model. A hierarchy that is given is used for a number of parts, one that
/// isn't is found where a number is asked for and left in `hierarchy`. Throws Error(usage) when there are no
/// such parts.
[[nodiscard]] segment::Segmentation find_parts(const mesh::Model& model, const std::string& file,
                                               const PartArguments& parts,
                                               std::optional<segment::Hierarchy>& hierarchy,
                                               const Context& context);

}  // namespace ridgecraft::cli
