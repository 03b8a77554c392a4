// SPDX-License-Identifier: GPL-3.0-or-later
// A model with few enough faces to be folded by hand. Private to prepare/.
#pragma once

#include <optional>

#include "base/context.hpp"
#include "mesh/model/model.hpp"
#include "prepare/prepared/options.hpp"
#include "prepare/prepared/prepared.hpp"

namespace ridgecraft::prepare {

/// What a model was before its faces became fewer, and what was done to it.
struct Dense {
  mesh::Surface before;
  double short_edges_fraction = 0.0;  ///< of its folds, those that are short (walls.hpp)
  double asymmetry_mm = 0.0;          ///< how far its sides were from being mirror images, which they are now
};

/// Whether a surface in mm has so many faces, and so many more than its folds can be long, that most of them
/// may go without care. Linear.
[[nodiscard]] bool is_dense(const mesh::Surface& surface, const SimplifyOptions& options);

/// Where a dense model has walls, which later steps have to find, nothing is done. Else quick collapses take
/// most of its faces: what is left is still much finer than anything that can be folded. Large flat regions,
/// borders and mirror planes stay. None where nothing was done. O(n log n).
[[nodiscard]] std::optional<Dense> thin_out(mesh::Model& model, double symmetric_within,
                                            const SimplifyOptions& options, const Context& context);

/// Samples by which it is measured how far a surface moved are this share of its largest extent apart.
inline constexpr double sample_spacing = 0.015;

/// Remeshes the panels of a model in millimetres and simplifies it as the options ask; the result is
/// remeshed, too. O(n log n).
[[nodiscard]] SimplifyReport simplify(mesh::Model& model, const SimplifyOptions& options,
                                      const Context& context);

}  // namespace ridgecraft::prepare
