// SPDX-License-Identifier: GPL-3.0-or-later
// The tabs of a tree while the tree changes: what fits where, which are chosen, kept up to date around a
// change.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "mesh/surface.hpp"
#include "unfold/tab_shapes.hpp"
#include "unfold/tab_sites.hpp"
#include "unfold/tab_targets.hpp"
#include "unfold/tree_search.hpp"

namespace ridgecraft::unfold {

/// Usable tabs on the cuts of a net. Cuts to faces outside the patch are left out: what happens beyond isn't
/// known. A simplification of place_tabs, which has the last word: corners are shared where they are one
/// vertex of the surface and lie at one place, and tabs are counted, not weighed.
class TabState {
 public:
  TabState(const mesh::Surface& surface, const mesh::Panels& panels, const Patch& patch, TreeSearch& net,
           const TabOptions& options);

  /// Looks at all sides afresh.
  void renew_all();
  /// Looks at the sides of these faces afresh and finds tabs for cuts that have none there.
  void renew(std::vector<std::uint32_t>& faces);
  /// Changes from here on can be taken back.
  void begin();
  void roll_back();

  /// Cuts with a usable tab.
  [[nodiscard]] std::uint32_t tabs() const { return tabs_; }
  [[nodiscard]] bool is_cut(std::uint32_t side) const {
    return patch_.twin[side] == nothing ? targets_.seam[side] != 0
                                        : patch_.frozen[side] == 0 && net_.folds()[side] == 0;
  }
  [[nodiscard]] bool has_tab(std::uint32_t side) const { return chosen_[join_of(side)].side != nothing; }
  /// The side by which a cut is counted.
  [[nodiscard]] std::uint32_t join_of(std::uint32_t side) const {
    return patch_.twin[side] < side ? patch_.twin[side] : side;
  }
  /// The tab that grows from a side, in the frame of tab shapes; nothing if there is none.
  [[nodiscard]] const ConvexShape* tab_on(std::uint32_t side) const {
    const Choice& choice = chosen_[join_of(side)];
    return choice.side == side ? &choice.outline : nullptr;
  }
  /// How many of the two sides of an edge inside the patch could give a usable tab if nothing were in the
  /// way.
  [[nodiscard]] std::uint32_t chances(std::uint32_t side) const {
    return (targets_.largest[side].empty() ? 0U : 1U) +
           (targets_.largest[patch_.twin[side]].empty() ? 0U : 1U);
  }
  /// How far from a face another one can still matter to its tabs, mm.
  [[nodiscard]] double reach() const { return options_.height_mm + options_.clearance_mm; }

 private:
  struct Choice {
    std::uint32_t side = nothing;  ///< none: no tab
    ConvexShape outline;
  };
  /// A tab that stands near a side.
  struct Near {
    std::uint32_t join = 0;
    std::uint32_t side = 0;
  };

  [[nodiscard]] Vec2 start(std::uint32_t side) const { return net_.flat(side / 3)[side % 3]; }
  [[nodiscard]] Vec2 end(std::uint32_t side) const { return net_.flat(side / 3)[(side % 3 + 1) % 3]; }
  [[nodiscard]] Frame frame(std::uint32_t side) const;
  [[nodiscard]] bool shares(std::uint32_t vertex, Vec2 place, std::uint32_t face) const;
  [[nodiscard]] std::vector<Obstacle> obstacles(std::uint32_t side, const ConvexShape& room);
  void look_at(std::uint32_t side);
  void set_shapes(std::uint32_t side, std::vector<TabShape> shapes);
  void choose(std::uint32_t join, const Choice& choice);
  [[nodiscard]] std::vector<Near> tabs_near(std::uint32_t side);
  [[nodiscard]] bool clear(std::uint32_t side, const ConvexShape& tab, const Near& other) const;
  [[nodiscard]] bool place(std::uint32_t join, int may_push);
  [[nodiscard]] bool place_trimmed(std::uint32_t side, const std::vector<Near>& near);
  [[nodiscard]] bool push_aside(std::uint32_t join, std::uint32_t side, const ConvexShape& outline,
                                const std::vector<std::uint32_t>& others, int may_push);

  const mesh::Surface& surface_;
  const Patch& patch_;
  TreeSearch& net_;
  TabOptions options_;
  TabTargets targets_;
  std::vector<std::uint32_t> vertex_;          ///< of the surface, at the start of each side
  std::vector<std::vector<TabShape>> shapes_;  ///< per side, usable among the faces, best first
  std::vector<Choice> chosen_;                 ///< per join (its smaller side)
  std::uint32_t tabs_ = 0;

  bool recording_ = false;
  std::vector<std::pair<std::uint32_t, std::vector<TabShape>>> old_shapes_;
  std::vector<std::pair<std::uint32_t, Choice>> old_choices_;
};

}  // namespace ridgecraft::unfold
