// SPDX-License-Identifier: GPL-3.0-or-later
// What is done to a model's bodies before they are united (prepare/skin).
#pragma once

#include "base/context.hpp"
#include "mesh/model/model.hpp"
#include "prepare/prepared/options.hpp"
#include "prepare/prepared/prepared.hpp"

namespace ridgecraft::prepare {

/// Leaves out bodies that nobody could cut and hold at this size, and of a model that has
/// too many faces still those that would be hard to fold; tells how many. Worth doing again when bodies were
/// united: what closes an opening may lie right behind a pane. None where faces are to be kept. O(n log n).
/// Throws Error(interrupted), Error(out_of_time).
Details leave_out_details(mesh::Model& model, const SizeOptions& size, const SimplifyOptions& simplify,
                          const Context& context);

/// Bodies that nobody could cut and hold at this size are left out: once united with a wall, they would be
/// details of it that nothing takes away any more. Thin walls become sheets before that (prepare/bodies). The
/// model keeps its place and unit. Models that keep their faces stay as they are. O(n log n). Throws
/// Error(interrupted), Error(out_of_time).
CleanupReport clean_bodies(mesh::Model& model, const SizeOptions& size, const SimplifyOptions& simplify,
                           const Context& context);

}  // namespace ridgecraft::prepare
