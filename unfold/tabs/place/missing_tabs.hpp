// SPDX-License-Identifier: GPL-3.0-or-later
// Joins that have no usable tab although they could have one, and what takes its room.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/context.hpp"
#include "mesh/model/surface.hpp"
#include "prepare/prepared/panels.hpp"
#include "unfold/net/nets.hpp"
#include "unfold/net/options.hpp"
#include "unfold/patch/patch.hpp"
#include "unfold/tabs/place/place_tabs.hpp"
#include "unfold/tabs/shape/shapes.hpp"

namespace ridgecraft::unfold {

/// A join without a usable tab that could have one.
struct TabGap {
  /// A tab that is tried (shapes.hpp).
  struct Place {
    FaceId face;                     ///< it grows from
    std::vector<FaceId> in_the_way;  ///< faces of its piece that it would meet, or the tabs of
  };
  JoinId join;
  std::vector<Place> places;
};

class TabGaps {
 public:
  /// What stays together whatever is cut: the folds of the forest that are frozen in the patch (of the whole
  /// surface). O(n log n).
  TabGaps(const TabProblem& problem, const Patch& patch, const Folds& folds, const Context& context);

  /// Would a join of this edge have a usable tab if all that can be cut were? Others have no face behind them
  /// that is wide enough, or are in each other's way around one flat region.
  [[nodiscard]] bool able(EdgeId edge) const { return able_[edge] != 0; }

  /// The joins of able edges that have no usable tab.
  [[nodiscard]] std::vector<JoinId> missing(const Nets& nets) const;

  /// What stands in the way of their tabs. About O(joins + faces). Throws Error(interrupted).
  [[nodiscard]] std::vector<TabGap> gaps(const Nets& nets, std::span<const JoinId> joins,
                                         const Context& context) const;

 private:
  class Surroundings;

  const mesh::Surface& surface_;
  const TabOptions& options_;
  IdVector<EdgeId, std::uint8_t> able_;
  std::vector<std::vector<TabCandidate>> candidates_;  ///< per corner: its side
};

// Tabs beyond the one that each join has (is_additional): on its other side, and at edges that are glued to
// nothing.

/// Gives joins whose request asks for it a second tab, the mirror image of the first one or what room leaves
/// of it: the two are glued to each other. Where the choice wants them, tabs at borders, too, which have no
/// join. They come after all others, keep clear of them, and are left out on pieces that don't fit the sheet
/// with them. O(n log n) for pieces of bounded size. Throws Error(interrupted).
void add_more_tabs(const TabProblem& problem, const std::optional<Sheet>& sheet, const TabChoice& choice,
                   Nets& nets, const Context& context);

}  // namespace ridgecraft::unfold
