// SPDX-License-Identifier: GPL-3.0-or-later
// Which bodies lie inside others: nobody can put them there once the outer one is closed.
#pragma once

#include <vector>

#include "export/assembly/seam_graph.hpp"

namespace ridgecraft::paper {

/// The groups of the graph in an order in which each comes after those that lie inside it, and else
/// the larger first, by its area. A group with a border encloses nothing; inside another lies what doesn't
/// stand out of it anywhere and is a millimetre off its faces somewhere (surface in mm). O(groups log groups
/// + pairs of boxes that meet + faces of groups whose boxes hold others).
[[nodiscard]] std::vector<std::size_t> inner_groups_first(const mesh::Surface& surface,
                                                          const unfold::Nets& nets, const SeamGraph& graph);

}  // namespace ridgecraft::paper
