// SPDX-License-Identifier: GPL-3.0-or-later
// Which part of a model has to be simplified when the rest is its mirror image or its copy. Private to
// prepare/.
#pragma once

#include "base/context.hpp"
#include "mesh/model/model.hpp"
#include "prepare/domains/domain.hpp"

namespace ridgecraft::prepare {

/// Looks for a mirror plane of the model and for twins among its components. A plane will do that the model
/// is mirrored at only nearly, off by up to `largest_deviation` (a fraction of the extent): then the side
/// with more faces is kept. Materials stay what they are on each side. O(n log n).
[[nodiscard]] FundamentalDomain fundamental_domain(const mesh::Model& model, double largest_deviation,
                                                   const Context& context);

}  // namespace ridgecraft::prepare
