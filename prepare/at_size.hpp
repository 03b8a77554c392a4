// SPDX-License-Identifier: GPL-3.0-or-later
// A model made ready for paper at a given size. Private to prepare/.
#pragma once

#include "base/context.hpp"
#include "mesh/model/model.hpp"
#include "prepare/prepared/options.hpp"
#include "prepare/prepared/prepared.hpp"

namespace ridgecraft::prepare {

/// As prepare() says, at the size that `size` names, whatever comes of it. O(n log n).
[[nodiscard]] Prepared prepare_at_size(mesh::Model model, const SizeOptions& size,
                                       const SimplifyOptions& simplify, const PanelRoom& room,
                                       const Context& context);

/// Sets what `simplified` says of the folds that are left, as they are at this size. Linear.
void judge_folds(Prepared& prepared, const SimplifyOptions& simplify);

}  // namespace ridgecraft::prepare
