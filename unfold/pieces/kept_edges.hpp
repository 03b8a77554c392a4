// SPDX-License-Identifier: GPL-3.0-or-later
// Which of the edges that are to be kept can be kept: all of them as folds of clean nets that fit.
#pragma once

#include <cstddef>

#include "base/context.hpp"
#include "mesh/model/surface.hpp"
#include "prepare/prepared/panels.hpp"
#include "unfold/net/edge_wishes.hpp"
#include "unfold/patch/room.hpp"

namespace ridgecraft::unfold {

struct KeptEdges {
  EdgeWishes wishes;       ///< without what couldn't be kept
  prepare::Panels groups;  ///< panels that kept edges hold together, as one each
};

/// Panels that kept edges hold together must lie flat without overlap and fit the room. All edges between
/// them are tried at once, then, where that fails, one after the other, long ones first. Wishes inside panels
/// and at borders are dropped.
[[nodiscard]] KeptEdges settle_wishes(const mesh::Surface& surface, const prepare::Panels& panels,
                                      const EdgeWishes& wishes, const Room& room, double tolerance,
                                      const Context& context);

}  // namespace ridgecraft::unfold
