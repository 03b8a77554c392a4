// SPDX-License-Identifier: GPL-3.0-or-later
// Joins that have no usable tab although they could have one, and what takes its room.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/context.hpp"
#include "mesh/model/surface.hpp"
#include "prepare/prepared/panels.hpp"
#include "unfold/net/nets.hpp"
#include "unfold/patch/patch.hpp"
#include "unfold/tabs/shape/candidates.hpp"

namespace ridgecraft::unfold {

/// A join without a usable tab that could have one.
struct TabGap {
  /// A tab that is tried (candidates.hpp).
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
  TabGaps(const mesh::Surface& surface, const prepare::Panels& panels, const Patch& patch, const Folds& folds,
          const TabOptions& options, const Context& context);

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

}  // namespace ridgecraft::unfold
