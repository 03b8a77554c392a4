// SPDX-License-Identifier: GPL-3.0-or-later
// Tabs that are put into slits of the face beyond their edge instead of glued behind it.
#pragma once

#include <cstdint>
#include <vector>

#include "base/context.hpp"
#include "mesh/model/surface.hpp"
#include "prepare/prepared/panels.hpp"
#include "unfold/net/nets.hpp"

namespace ridgecraft::unfold {

/// Makes arrows (arrows.hpp) of the tabs of those joins for which `asked`, by join, isn't 0, where the face
/// beyond has room for their slits: each keeps its distance from all cuts and folds of its piece, and what is
/// laid on or glued behind that face keeps clear of it. A long edge gets several; those beyond the first are
/// additional tabs of its join. All other tabs stay as they are. Returns, by join, where there are arrows.
/// About O(n log n). Throws Error(interrupted).
std::vector<std::uint8_t> put_into_slits(const mesh::Surface& surface, const prepare::Panels& panels,
                                         const std::vector<std::uint8_t>& asked, Nets& nets,
                                         const Context& context);

}  // namespace ridgecraft::unfold
