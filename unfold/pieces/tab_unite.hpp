// SPDX-License-Identifier: GPL-3.0-or-later
// Pieces that were split for tabs become one again where that costs no tab.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "base/context.hpp"
#include "mesh/model/surface.hpp"
#include "prepare/prepared/panels.hpp"
#include "unfold/net/options.hpp"
#include "unfold/patch/patch.hpp"
#include "unfold/patch/room.hpp"
#include "unfold/pieces/split_forest.hpp"
#include "unfold/tabs/place/missing_tabs.hpp"

namespace ridgecraft::unfold {

/// What uniting has to know and to keep.
struct TabUnions {
  const mesh::Surface& surface;
  const prepare::Panels& panels;
  const Patch& patch;
  const Room& room;
  const TabOptions& options;
  const TabGaps& tab_gaps;
  const NetsOf& nets_of;
  std::span<const std::uint32_t> origin;  ///< per face: only pieces of one origin are united
  double tolerance = 0.0;                 ///< of overlap, mm
  bool search = false;                    ///< unfold two pieces afresh too where no cut between them will do
};

/// Unites neighbouring pieces, the smallest first, wherever the nets then lack no more usable tabs than
/// before (`missing`), until no two can be. Deterministic for one seed but for the deadline.
[[nodiscard]] TabSplit unite_with_tabs(const TabUnions& rules, const Folds& folds, std::size_t missing,
                                       std::uint64_t seed, const Context& context);

}  // namespace ridgecraft::unfold
