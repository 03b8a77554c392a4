// SPDX-License-Identifier: GPL-3.0-or-later
// Flat regions that no page holds are cut by straight lines before anything is unfolded. Private to prepare/.
#pragma once

#include <cstddef>

#include "base/context.hpp"
#include "prepare/prepared/options.hpp"
#include "prepare/prepared/prepared.hpp"

namespace ridgecraft::prepare {

/// Cuts each panel that doesn't fit the page along straight lines (prepare/panels/page_cuts.hpp) until what
/// is left fits with room for tabs on both sides, where the page has that. Each of these cells becomes a
/// panel; sides that a line crosses get a vertex there, so that the surface stays a surface, of the same
/// shape. Returns how many panels were cut. Throws Error(no_nets) where more than a million faces would come
/// of it. O(n) for the panels that fit; O(faces * cuts) for the others.
std::size_t divide_panels(mesh::Model& model, Panels& panels, const PanelRoom& room, const Context& context);

}  // namespace ridgecraft::prepare
