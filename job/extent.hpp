// SPDX-License-Identifier: GPL-3.0-or-later
// Sizes as people give them who know how the model stands: its height, width or depth.
#pragma once

#include "base/vector.hpp"
#include "job/options.hpp"
#include "mesh/model/model.hpp"

namespace ridgecraft::job {

/// The model's largest extent as a multiple of this one; the model stands on its foot with this axis upwards
/// (export/view/camera.hpp). Throws Error(usage) where it has no such extent. O(faces).
[[nodiscard]] double largest_share(const mesh::Model& model, ExtentKind kind, mesh::Axis up);

}  // namespace ridgecraft::job
