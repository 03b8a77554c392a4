// SPDX-License-Identifier: GPL-3.0-or-later
// One component is made coarse enough to be folded by hand. Private to prepare/.
#pragma once

#include <cstddef>
#include <optional>

#include "base/context.hpp"
#include "mesh/repair/loose_faces.hpp"
#include "prepare/prepared/options.hpp"
#include "prepare/shares/share.hpp"
#include "prepare/walls/walls.hpp"

namespace ridgecraft::prepare {

/// What a body is part of.
struct BodyRules {
  const mesh::LooseFaces& model;  ///< the whole, taken apart
  const Walls* walls;             ///< of the whole
  double spacing_mm = 0.0;        ///< of samples for the deviation
  double largest_mm = 0.0;        ///< how far the surface may move
  std::size_t most_faces = 0;     ///< that the body and its copies may have together
};

/// The share of one component, simplified as far as it must be and within what the rules allow; none where it
/// stays as it is since it can be folded, or since simplification wouldn't help it enough. O(n log n).
[[nodiscard]] std::optional<SymmetricShare> simplified_body(const SymmetricShare& body,
                                                            const BodyRules& rules,
                                                            const SimplifyOptions& options,
                                                            const Context& context);

}  // namespace ridgecraft::prepare
