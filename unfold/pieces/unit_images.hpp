// SPDX-License-Identifier: GPL-3.0-or-later
// Flat regions and faces of a symmetric model, and which of them lie on which.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/id.hpp"
#include "mesh/model/surface.hpp"
#include "unfold/patch/patch.hpp"

namespace ridgecraft::unfold {

/// Units are faces that stay together whatever the tree (flat regions), the others one by one. Per face: its
/// unit, by the number of one of its faces. O(n).
[[nodiscard]] std::vector<std::uint32_t> units_of(const Patch& patch);

/// Per unit the one whose outline most of its own outline lies on, by `images` of edges; `nothing` where
/// there is none, and for numbers that are no unit's. Two may have the same image. O(n log n).
[[nodiscard]] std::vector<std::uint32_t> unit_images(const mesh::Surface& surface, const Patch& patch,
                                                     std::span<const std::uint32_t> unit,
                                                     const IdVector<EdgeId, EdgeId>& images);

}  // namespace ridgecraft::unfold
