// SPDX-License-Identifier: GPL-3.0-or-later
// Pieces as the packer sees them, and their layout on pages.
#pragma once

#include <cstdint>
#include <vector>

#include "base/geometry.hpp"
#include "base/id.hpp"
#include "base/vector.hpp"
#include "export/packing/packing_shape.hpp"
#include "export/sheet/paper.hpp"
#include "unfold/net/nets.hpp"

namespace ridgecraft::export_ {

/// Rounding in distances between pieces, mm.
inline constexpr double gap_rounding_mm = 1e-6;

/// All pieces with their tabs, each in the plane of its net; those of one part belong together. Where the
/// paper has a grain they keep to turns in which their folds run along it.
[[nodiscard]] PackingTask packing_task(const unfold::Nets& nets, const Paper& paper,
                                       const IdVector<PieceId, Vec2>& fold_directions = {});

/// Some of the shapes, in this order.
[[nodiscard]] PackingTask part_of(const PackingTask& task, const std::vector<std::uint32_t>& shapes);

/// Throws Error(no_nets) naming a piece that fits no page.
void check_fit(const unfold::Nets& nets, const PackingTask& task, const Paper& paper);

/// The convex polygons of a shape where it is placed.
[[nodiscard]] std::vector<std::vector<Vec2>> placed(const PackingShape& shape, const Rigid& placement);

}  // namespace ridgecraft::export_
