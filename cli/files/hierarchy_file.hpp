// SPDX-License-Identifier: GPL-3.0-or-later
// The file of segment --hierarchy: all segmentations of a model at once.
#pragma once

#include <string>

#include "mesh/model/model.hpp"
#include "segment/hierarchy.hpp"

namespace ridgecraft::cli {

/// One JSON object in one line: the leaf of each polygon, and which nodes were joined at which
/// concavity. Carries the mark of the model. O(n).
[[nodiscard]] std::string hierarchy_text(const mesh::Model& model, const segment::Hierarchy& hierarchy);

}  // namespace ridgecraft::cli
