// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies that nobody could cut and hold are left out before others are united with them. Private to prepare/.
#pragma once

#include <cstddef>

#include "base/context.hpp"
#include "mesh/model/model.hpp"
#include "prepare/prepared/ready_report.hpp"

namespace ridgecraft::prepare {

/// What is too small, and where that is worth leaving out.
struct DetailLimits {
  double narrow = 0.0;       ///< in the unit of the surface
  double least_faces = 0.0;  ///< the share of the model's faces that details have at least, else all stay
};

/// Leaves out four kinds of components, short ones: those with less area than a square
/// of twice `narrow`; strips narrower than `narrow` (window bars, wires); small flat sheets that are
/// everywhere nearer than that to another component (panes, painted stones); bodies that stand out of
/// large ones, or into them, by less than that all over (window frames, buttons). Extents are those along a
/// component's principal axes. Where the first three have more than a tenth of the model's area together,
/// they are what the model is made of, and all stay. O(n log n).
[[nodiscard]] Details leave_out_details(mesh::Model& model, const DetailLimits& limits,
                                        const Context& context);

}  // namespace ridgecraft::prepare
