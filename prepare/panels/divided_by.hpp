// SPDX-License-Identifier: GPL-3.0-or-later
// Flat regions that end where something else does: a material, an object.
#pragma once

#include <cstdint>

#include "base/id.hpp"
#include "mesh/model/surface.hpp"
#include "prepare/prepared/panels.hpp"

namespace ridgecraft::prepare {

/// The same panels divided where faces of different labels meet, one label for each face. O(n log n).
[[nodiscard]] Panels divided_by(const Panels& panels, const mesh::Surface& surface,
                                const IdVector<FaceId, std::uint32_t>& label);

}  // namespace ridgecraft::prepare
