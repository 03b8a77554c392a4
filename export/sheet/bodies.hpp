// SPDX-License-Identifier: GPL-3.0-or-later
// The separate bodies of a model: which pieces make each, and beside which piece it belongs. Nothing joins
// them on paper, so a maker has to be told.
#pragma once

#include <vector>

#include "prepare/prepared/prepared.hpp"
#include "unfold/net/nets.hpp"

namespace ridgecraft::paper {

/// A component of the surface, by its pieces.
struct Body {
  std::vector<PieceId> pieces;  ///< ascending
  PieceId beside;               ///< the nearest piece of another body; none where there are too many bodies
  double distance_mm = 0.0;     ///< from it
};

/// The components of the surface in the order of their first pieces; empty where there is only one. Distances
/// are those of vertices from faces, both ways, of as many vertices as a fixed amount of work allows.
[[nodiscard]] std::vector<Body> find_bodies(const prepare::Prepared& model, const unfold::Nets& nets);

}  // namespace ridgecraft::paper
