// SPDX-License-Identifier: GPL-3.0-or-later
// The separate bodies of a model: which pieces make each, and beside which piece it belongs. No tab joins
// them, so a maker has to be told.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "export/sheet/contacts.hpp"
#include "prepare/prepared/prepared.hpp"
#include "unfold/net/nets.hpp"

namespace ridgecraft::export_ {

/// A component of the surface, by its pieces.
struct Body {
  std::vector<PieceId> pieces;  ///< ascending
  PieceId beside;               ///< the nearest piece of another body; none where there are too many bodies
  double distance_mm = 0.0;     ///< from it
  /// Its pieces that are glued onto those of other bodies within an outline, with these; ascending.
  std::vector<std::array<PieceId, 2>> glued_onto;
};

/// The components of the surface in the order of their first pieces; empty where there is only one. Distances
/// are those of vertices from faces, both ways, of as many vertices as a fixed amount of work allows.
[[nodiscard]] std::vector<Body> find_bodies(const prepare::Prepared& model, const unfold::Nets& nets,
                                            std::span<const Contact> contacts);

/// How many there are when those that are glued onto each other count as one.
[[nodiscard]] std::size_t bodies_apart(std::span<const Body> bodies);

}  // namespace ridgecraft::export_
