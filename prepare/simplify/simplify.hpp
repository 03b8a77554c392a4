// SPDX-License-Identifier: GPL-3.0-or-later
// A model with few enough faces to be folded by hand. Private to prepare/.
#pragma once

#include "base/context.hpp"
#include "mesh/model/model.hpp"
#include "prepare/prepared/options.hpp"
#include "prepare/prepared/prepared.hpp"

namespace ridgecraft::prepare {

/// What a surface that moved by so much exceeds a budget by.
[[nodiscard]] double change_excess(double moved_mm, double extent_mm, const SimplifyOptions& options);

/// Remeshes the panels of a model in millimetres and simplifies it as the options ask; the result is
/// remeshed, too. O(n log n).
[[nodiscard]] SimplifyReport simplify(mesh::Model& model, const SimplifyOptions& options,
                                      const Context& context);

}  // namespace ridgecraft::prepare
