// SPDX-License-Identifier: GPL-3.0-or-later
// Names of pieces and numbers of joins, in an order that a person can follow.
#pragma once

#include <string>

#include "mesh/model/surface.hpp"
#include "unfold/net/nets.hpp"

namespace ridgecraft::unfold {

/// A, B, ... Z, AA, AB, ... for 0, 1, ...
[[nodiscard]] std::string piece_name(std::size_t number);

/// Makes a join of every cut edge. Numbers follow the seams on the model: parts in their order, in each part
/// along the cuts from edge to neighbouring edge, staying between the same two pieces and going straight on
/// where that is possible, so that neighbours on the model have neighbouring numbers. Needs use, piece and
/// pieces of `nets`. O(n log n).
void number_joins(const mesh::Surface& surface, Nets& nets);

}  // namespace ridgecraft::unfold
