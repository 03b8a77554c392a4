// SPDX-License-Identifier: GPL-3.0-or-later
// A model made ready for paper at a given size. Private to prepare/.
#pragma once

#include "base/context.hpp"
#include "mesh/model/model.hpp"
#include "prepare/prepared/options.hpp"
#include "prepare/prepared/prepared.hpp"

namespace ridgecraft::prepare {

/// How a model was brought to its size: a point p of it is now factor * (p - centre).
struct Resized {
  double mm_per_unit = 1.0;  ///< of the file
  double factor = 1.0;
  Vec3 centre;
};

/// Moves the bounding box's centre to the origin and scales the points. Throws Error(no_nets) where the
/// result would have no size at all or one that no number of sheets can hold.
Resized resize(mesh::Model& model, const SizeOptions& size);

/// As prepare() says, at the size that `size` names, whatever comes of it. O(n log n).
[[nodiscard]] Prepared prepare_at_size(mesh::Model model, const SizeOptions& size,
                                       const SimplifyOptions& simplify, const PanelRoom& room,
                                       const Context& context);

}  // namespace ridgecraft::prepare
