// SPDX-License-Identifier: GPL-3.0-or-later
// Screw holes and knobs of flat walls go before anything else is simplified. Private to prepare/.
#pragma once

#include <cstddef>

#include "mesh/model/model.hpp"
#include "prepare/prepared/options.hpp"

namespace ridgecraft::prepare {

/// Closes what opens in a wall within a loop no larger than a short edge, and goes no deeper or higher than
/// `largest_mm`: holes through plates, blind ones, studs, engraved and raised letters. The wall goes on flat
/// there. Returns how many. Panels must have been remeshed; they must be again. O(n log n).
std::size_t remove_features(mesh::Model& model, const SimplifyOptions& options, double largest_mm);

}  // namespace ridgecraft::prepare
