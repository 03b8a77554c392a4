// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies that nobody could cut and hold are left out before others are united with them. Private to prepare/.
#pragma once

#include <cstddef>

#include "base/context.hpp"
#include "mesh/model/model.hpp"
#include "prepare/prepared/ready_report.hpp"

namespace ridgecraft::prepare {

/// Leaves out three kinds of components: those smaller than `narrow` in every direction; strips narrower than
/// it (window bars, wires) that are short beside the model; and small flat sheets that are everywhere nearer
/// than it to another component (panes, painted stones). `narrow` is in the unit of the surface. Extents are those along a component's principal axes. Where they have
/// more than a tenth of the model's area together, they are what the model is made of, and all stay.
/// O(n log n).
[[nodiscard]] Details leave_out_details(mesh::Model& model, double narrow,
                                        const Context& context);

}  // namespace ridgecraft::prepare
