// SPDX-License-Identifier: GPL-3.0-or-later
// How short what a machine does may be: rounding makes shorter paths and steps, and a laser burns holes
// there.
#pragma once

namespace ridgecraft::export_ {

/// No path is shorter, mm.
inline constexpr double shortest_path_mm = 0.2;
/// No point of a path is nearer to the one before, mm.
inline constexpr double nearest_points_mm = 0.05;

}  // namespace ridgecraft::export_
