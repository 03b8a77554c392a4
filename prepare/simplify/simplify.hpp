// SPDX-License-Identifier: GPL-3.0-or-later
// A model with few enough faces to be folded by hand. Private to prepare/.
#pragma once

#include "base/context.hpp"
#include "prepare/prepared/options.hpp"
#include "prepare/prepared/prepared.hpp"

namespace ridgecraft::prepare {

/// Share of the drawn folds (edges between panels, folded by hidden_fold_angle or more) that are shorter
/// than short_edge_mm; 0 where there are none. Panels must have been remeshed: then a straight fold between
/// two of them is one edge.
[[nodiscard]] double short_fold_share(const mesh::Surface& surface, const SimplifyOptions& options);

/// Simplifies a model in millimetres with remeshed panels as the options ask; the result is remeshed, too.
/// O(n log n).
[[nodiscard]] SimplifyReport simplify(mesh::Model& model, const SimplifyOptions& options,
                                      const Context& context);

}  // namespace ridgecraft::prepare
