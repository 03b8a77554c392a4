// SPDX-License-Identifier: GPL-3.0-or-later
// The greatest distance between two surfaces, as it is told.
#pragma once

#include "base/context.hpp"
#include "mesh/model/surface_distance.hpp"

namespace ridgecraft::mesh {

/// Greatest distance between points of each surface and the other surface, both ways: at the samples of the
/// trees first, then wherever a face that is larger than the samples' spacing leaves room for more than was
/// found. Faces are divided where they may be farthest off (branch and bound: M. Guthe, P. Borodin, R. Klein,
/// "Fast and accurate Hausdorff distance calculation between meshes", 2005) until no more than a
/// hundredth of what was found and half a hundredth of the spacing could be added, or 20,000 parts have been
/// divided each way. The same with every standard library. Throws Error(interrupted), Error(out_of_time). O(n
/// log n).
[[nodiscard]] double measured_distance(const SurfaceTree& a, const SurfaceTree& b, const Context& context);

}  // namespace ridgecraft::mesh
