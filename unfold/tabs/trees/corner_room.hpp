// SPDX-License-Identifier: GPL-3.0-or-later
// Whether the outline of a net leaves tabs room at both ends of their edges: told by angles alone, without
// laying anything flat.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "unfold/patch/patch.hpp"
#include "unfold/tabs/shape/candidates.hpp"

namespace ridgecraft::unfold {

/// The cuts of a net with what the tabs are worth (tab_worth) that they have no room for, kept up to date
/// while cuts and folds are swapped. A tab has room when it keeps clear of the two sides of the outline that
/// meet its edge, taken as endless; what lies farther off isn't seen. A hundred times as quick as TabState.
class TabWedges {
 public:
  /// Per side: `candidates`, the tabs that might grow there, and `seam`, 1 where it leads out of the patch
  /// and should give the tab. The patch must outlive this.
  TabWedges(const Patch& patch, const std::vector<std::vector<TabCandidate>>& candidates,
            const std::vector<std::uint8_t>& seam, double clearance_mm);

  /// Takes a tree. O(n).
  void set_tree(const Folds& folds);
  /// Worth of all tabs that have no room, and a little for those that have it on one side only.
  [[nodiscard]] double missing() const { return missing_; }
  /// What one cut adds to it.
  [[nodiscard]] double missing_on(std::uint32_t side) const { return cost_[join_of(side)]; }
  /// What making `cut` a fold and `fold` a cut adds to missing(). Must be followed by keep() or drop(). O(1)
  /// for vertices of ordinary valence.
  [[nodiscard]] double change(std::uint32_t cut, std::uint32_t fold);
  void keep();
  void drop();

 private:
  /// Two edges, each with four neighbours on the outline.
  static constexpr std::size_t most_changed = 10;
  struct Angles {
    std::array<float, most_candidates> left{};
    std::array<float, most_candidates> right{};
    std::uint32_t count = 0;
  };

  [[nodiscard]] std::uint32_t join_of(std::uint32_t side) const {
    return patch_.twin[side] < side ? patch_.twin[side] : side;
  }
  void set_cut(std::uint32_t side, std::uint8_t cut);
  [[nodiscard]] bool has_room(std::uint32_t side) const;
  [[nodiscard]] double cost_of(std::uint32_t join) const;
  void note(std::uint32_t side);
  void note_neighbours(std::uint32_t side);

  const Patch& patch_;
  std::vector<std::uint8_t> cut_;  ///< per side: on the outline
  std::vector<std::uint8_t> seam_;
  std::vector<double> corner_angle_;  ///< per side: of its face at its start
  std::vector<Angles> needed_;        ///< per side: angles outside the paper that each candidate needs
  std::vector<double> cost_;          ///< per join (its smaller side)
  double missing_ = 0.0;

  // The swap that was rated last.
  std::uint32_t changed_cut_ = nothing;
  std::uint32_t changed_fold_ = nothing;
  std::array<std::uint32_t, most_changed> changed_{};
  std::array<double, most_changed> new_cost_{};
  std::size_t changes_ = 0;
  double sum_ = 0.0;
};

}  // namespace ridgecraft::unfold
