// SPDX-License-Identifier: GPL-3.0-or-later
// Flat regions of shapes made in code.
#pragma once

#include "mesh/model/surface.hpp"
#include "prepare/prepared/panels.hpp"

namespace ridgecraft::test {

/// Panels grown over edges that aren't folded (within 1e-6 rad), their faces in ascending order: enough for
/// shapes made of exact flat regions.
[[nodiscard]] prepare::Panels flat_panels(const mesh::Surface& surface);

}  // namespace ridgecraft::test
