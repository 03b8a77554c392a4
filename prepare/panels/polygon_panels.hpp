// SPDX-License-Identifier: GPL-3.0-or-later
// Faces of a file that aren't quite flat. Private to prepare/.
#pragma once

#include "mesh/model/model.hpp"
#include "prepare/prepared/panels.hpp"

namespace ridgecraft::prepare {

/// The panels of a model's surface, but for two triangles that were one face of the file and meet at less
/// than 20 degrees: these are one. Whoever uses them must not take them for flat. O(n log n).
[[nodiscard]] Panels find_polygon_panels(const mesh::Model& model);

}  // namespace ridgecraft::prepare
