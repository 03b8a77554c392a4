// SPDX-License-Identifier: GPL-3.0-or-later
// A net whose tree changes by one fold at a time, with its tabs: what all searches among the trees of a piece
// share.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "mesh/model/surface.hpp"
#include "prepare/prepared/panels.hpp"
#include "unfold/search/overlap_pairs.hpp"
#include "unfold/search/rooted_net.hpp"
#include "unfold/search/tree_search.hpp"
#include "unfold/tabs/trees/tabs_of_tree.hpp"

namespace ridgecraft::unfold {

/// The net of a connected patch, which must outlive it. What a swap does to the tabs is only looked at when
/// somebody asks: a swap that is refused for something else costs none of that.
class ChangingNet {
 public:
  /// Tabs are counted where `tabs` wants them; of overlap, deeper than `tolerance` (mm) counts.
  ChangingNet(const mesh::Surface& surface, const prepare::Panels& panels, const Patch& patch,
              const Folds& folds, const TabOptions& tabs, double tolerance);
  /// The tree spans `joined`, tabs see the cuts of `patch`: pieces that are searched together
  /// (patch.hpp).
  ChangingNet(const mesh::Surface& surface, const prepare::Panels& panels, const Patch& patch,
              const Patch& joined, const Folds& folds, const TabOptions& tabs, double tolerance);
  /// Without tabs.
  ChangingNet(const Patch& patch, const Folds& folds, double tolerance);
  ChangingNet(const ChangingNet&) = delete;
  ChangingNet& operator=(const ChangingNet&) = delete;
  ~ChangingNet() = default;

  /// Takes another tree; it must span the patch. O(n log n) and all tabs anew.
  void set_tree(const Folds& folds);

  [[nodiscard]] const Patch& patch() const { return patch_; }
  [[nodiscard]] const Folds& folds() const { return net_.folds(); }
  [[nodiscard]] double tolerance() const { return tolerance_; }
  [[nodiscard]] RootedNet& tree() { return net_; }
  [[nodiscard]] const RootedNet& tree() const { return net_; }
  /// Corners of the convex hull. O(n log n).
  [[nodiscard]] std::vector<Vec2> hull() const;
  /// Whether nothing overlaps, laid out afresh: a search counts by small steps, so only this may call a net
  /// clean in the end.
  [[nodiscard]] bool is_clean() const;

  [[nodiscard]] bool has_tabs() const { return state_.has_value(); }
  /// Cuts with a usable tab (TabState); 0 where tabs aren't counted.
  [[nodiscard]] std::uint32_t tabs();
  /// Seam that they hold, mm.
  [[nodiscard]] double held_mm();
  /// Only with tabs, and while no swap is open.
  [[nodiscard]] const TabState& tab_state() const { return *state_; }

  /// Would it make no new overlap?
  [[nodiscard]] bool is_clean(const Swap& swap) { return after_swap_.is_clean(swap.below, swap.side); }
  /// Makes a swap. Must be followed by keep() or take_back().
  void make(const Swap& swap);
  /// The same where tabs will be asked for in any case. Only with tabs.
  void make_with_tabs(const Swap& swap);
  void keep();
  void take_back();

 private:
  void count_tabs();

  const Patch& patch_;
  const Patch& joined_;
  double tolerance_;
  RootedNet net_;
  SwapOverlaps after_swap_;
  std::optional<TabState> state_;
  // The open swap, if there is one.
  bool counted_ = true;       ///< the tabs know of it
  Swap back_;                 ///< takes it back, as long as they don't
  std::uint32_t folded_ = 0;  ///< a side of the new fold
};

}  // namespace ridgecraft::unfold
